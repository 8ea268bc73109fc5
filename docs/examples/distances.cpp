// SPDX-License-Identifier: MIT
// Distances from a vertex of a model, written to a file or, as here, to standard output.
#include <geotherm/geotherm.h>  // find_package(geotherm CONFIG), link geotherm::solver

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  auto method = require(build_method(mesh));  // everything that does not depend on the sources
  auto result = require(method->solve(SourceSet::of_vertices({17})));
  require(write_distances("-", *mesh, result.distances));
}
