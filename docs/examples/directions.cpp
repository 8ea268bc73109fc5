// SPDX-License-Identifier: MIT
// A log map, a straightest line, and a vector carried over the surface.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  auto directions = require(Directions::build(mesh));
  const SurfacePoint point = SurfacePoint::at_vertex(17);
  LogMap map = require(directions->log_map(point));
  TracedLine line = require(directions->trace(point, map.directions[900], map.distances[900]));

  auto heat = require(VectorHeat::build(mesh));
  Spread field = require(heat->transport(std::vector<TangentVector>{{17, 1, 0}}));
  std::printf("%.4f %.4f %.4f\n", map.directions[900], line.path.length, field.vectors[900].norm());
}
