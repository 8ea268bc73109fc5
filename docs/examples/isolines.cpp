// SPDX-License-Identifier: MIT
// Lines of equal distance.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  auto method = require(build_method(mesh));
  auto result = require(method->solve(SourceSet::of_vertices({17})));
  for (const Isoline& line :
       require(find_isolines(*mesh, result.distances, std::vector{0.1, 0.2}))) {
    std::printf("%g: length %.4f\n", line.value, line.path.length);
  }
}
