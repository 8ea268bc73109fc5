// SPDX-License-Identifier: MIT
// The shortest path between two vertices.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  auto waves = require(build_method(mesh, options));
  std::vector ends = {SurfacePoint::at_vertex(0), SurfacePoint::at_vertex(1500)};
  SurfacePath path = require(PathFinder(mesh, waves).find(ends)).path;
  std::printf("%zu points, length %.4f\n", path.points.size(), path.length);
}
