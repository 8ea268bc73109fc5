// SPDX-License-Identifier: MIT
// One method for many sources: the factors are made once.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  auto method = require(build_method(mesh));
  std::vector<SourceSet> sets;
  for (Index v = 0; v < 100; ++v) sets.push_back(SourceSet::of_vertices({v}));
  auto results = require(method->solve_each(sets));  // in blocks, on all cores
  std::printf("%.3f ms a source\n", results.front().timing.query);
}
