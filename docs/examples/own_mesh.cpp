// SPDX-License-Identifier: MIT
// A mesh from arrays: two triangles that are a square, cut finer.
#include <geotherm/geotherm.h>

#include "fail.h"

using namespace geotherm;

int main() {
  auto square =
      TriangleMesh::build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  if (!square) return fail(square.error());
  auto mesh = std::make_shared<const TriangleMesh>(*std::move(square));
  auto method = build_method(mesh, {.refine = 5});  // faces cut into four, five times
  if (!method) return fail(method.error());
  auto result = (*method)->solve(SourceSet::of_vertices({0}));
  if (!result) return fail(result.error());
  for (double distance : result->distances) std::printf("%.3f\n", distance);
}
