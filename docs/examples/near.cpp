// SPDX-License-Identifier: MIT
// What lies within a distance of each of some vertices, and nothing else: as sparse rows.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  MethodOptions options;
  options.method = MethodKind::kWavefront;  // heat would solve for all of the mesh and cut
  auto method = require(build_method(mesh, options));
  QueryOptions near;
  near.reach = {.max_distance = 0.2, .sparse = true};
  for (Index v = 0; v < 3; ++v) {
    auto row = require(method->solve(SourceSet::of_vertices({v}), near));
    std::printf("%zu vertices within 0.2 of vertex %d\n", row.vertices.size(), v);
  }
}
