// SPDX-License-Identifier: MIT
// A mesh from arrays: two triangles that are a square, cut finer.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto square = require(
      TriangleMesh::build({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  auto mesh = std::make_shared<const TriangleMesh>(std::move(square));
  MethodOptions options;
  options.refine = 5;  // every face is cut into four, five times
  auto method = require(build_method(mesh, options));
  auto result = require(method->solve(SourceSet::of_vertices({0})));
  for (double distance : result.distances) std::printf("%.3f\n", distance);
}
