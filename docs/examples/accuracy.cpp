// SPDX-License-Identifier: MIT
// The heat method beside wavefronts, and how far it is from them.
#include <geotherm/geotherm.h>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  MethodOptions wavefront;
  wavefront.method = MethodKind::kWavefront;
  auto heat = require(build_method(mesh)), waves = require(build_method(mesh, wavefront));
  auto fast = require(heat->solve(SourceSet::of_vertices({17})));
  auto good = require(waves->solve(SourceSet::of_vertices({17})));
  DistanceError error = distance_error(fast.distances, good.distances);
  std::printf("%s: %.2g on average\n", to_text(grade_of(error)).c_str(), error.mean_relative);
}
