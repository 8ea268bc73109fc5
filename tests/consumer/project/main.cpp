// SPDX-License-Identifier: MIT
// Distance over a unit square of two triangles, through the first backend there is.
#include <geotherm/geotherm.h>

#include <cmath>
#include <cstdio>

int main() {
  using namespace geotherm;
  Result<TriangleMesh> mesh =
      TriangleMesh::build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  if (!mesh) return std::fprintf(stderr, "%s\n", sentence(mesh.error()).c_str()), 1;

  HeatOptions options;
  options.backend = backend_names().front();
  const Result<HeatMethod> method =
      HeatMethod::build(std::make_shared<TriangleMesh>(std::move(*mesh)), options);
  if (!method) return std::fprintf(stderr, "%s\n", sentence(method.error()).c_str()), 1;

  const Result<DistanceResult> result = method->solve(SourceSet::of_vertices({0}));
  if (!result) return std::fprintf(stderr, "%s\n", sentence(result.error()).c_str()), 1;
  for (const double distance : result->distances) std::printf("%g\n", distance);
  return result->distances[0] == 0.0 && result->distances[2] > 0.5 ? 0 : 1;
}
