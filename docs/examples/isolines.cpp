// SPDX-License-Identifier: MIT
// Lines of equal distance.
#include <geotherm/geotherm.h>

#include "fail.h"

using namespace geotherm;

int main() {
  auto file = read_mesh("bunny.ply");
  if (!file) return fail(file.error());
  auto mesh = std::make_shared<const TriangleMesh>(std::move(file->mesh));
  auto method = build_method(mesh);
  if (!method) return fail(method.error());
  auto result = (*method)->solve(SourceSet::of_vertices({17}));
  if (!result) return fail(result.error());
  auto lines = find_isolines(*mesh, result->distances, std::vector{0.1, 0.2, 0.3});
  if (!lines) return fail(lines.error());
  for (const Isoline& line : *lines) std::printf("%g: %.4f\n", line.value, line.path.length);
}
