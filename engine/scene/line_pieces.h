// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace geotherm::engine {

/// One straight piece of a polyline with the points beside it, which decide how it joins its
/// neighbours. At an end of the polyline the point beside is the end itself.
struct LinePiece {
  glm::vec3 before, from, to, after;
};

/// A polyline without the points that are not finite, which cut it in two.
std::vector<std::vector<glm::vec3>> finite_runs(std::span<const glm::vec3> points);

/// The pieces of a polyline. Points that repeat the one before them, up to rounding in scene space,
/// are left out; where it ends in the point that it begins with it is closed. Points are finite.
/// Cost: O(points).
std::vector<LinePiece> line_pieces(std::span<const glm::vec3> points);

}  // namespace geotherm::engine
