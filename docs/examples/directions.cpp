// SPDX-License-Identifier: MIT
// Log maps, a straightest line, a vector carried over the surface, and a mean.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  auto directions = require(Directions::build(mesh));
  const SurfacePoint point = SurfacePoint::at_vertex(17);
  LogMap map = require(directions->log_map(point));
  LogMap near = require(directions->log_map(point, {MethodKind::kWavefront, 0.5, {}}));
  TracedLine line = require(directions->trace(point, map.directions[900], map.distances[900]));

  auto heat = require(VectorHeat::build(mesh));
  Spread field = require(heat->transport(std::vector<TangentVector>{{17, 1, 0}}));

  const std::vector<SurfacePoint> points = {point, SurfacePoint::at_vertex(900)};
  Centres centres = require(find_centres(mesh, points, std::vector<double>{2, 1}));
  std::printf("%.4f %.4f %.4f\n", map.directions[900], line.path.length, field.vectors[900].norm());
  std::printf("%.4f %.4f\n", near.distances[17], centres.found.front().distances[0]);
}
