// SPDX-License-Identifier: MIT
// A surface that moves: the same faces, with the vertices elsewhere in every frame.
#include <geotherm/geotherm.h>

#include <algorithm>
#include <cmath>

#include "require.h"

using namespace geotherm;

int main() {
  auto mesh = std::make_shared<const TriangleMesh>(require(read_mesh("bunny.ply")).mesh);
  auto method = require(build_method(mesh));
  for (int frame = 1; frame <= 5; ++frame) {
    std::vector<Vec3> positions(mesh->positions().begin(), mesh->positions().end());
    for (Vec3& p : positions) p.x() += 0.1 * std::sin(3 * p.y() - frame);
    auto moved = std::make_shared<const TriangleMesh>(require(mesh->moved(std::move(positions))));
    method = require(build_method_moved(moved, {}, method.get()));
    auto result = require(method->solve(SourceSet::of_vertices({17})));
    std::printf("frame %d: up to %.4f\n", frame, std::ranges::max(result.distances));
  }
}
