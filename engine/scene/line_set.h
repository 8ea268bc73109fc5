// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace geotherm::engine {

/// One straight piece of a polyline with the points beside it, which decide how it joins its
/// neighbours. At an end of the polyline the point beside is the end itself.
struct LinePiece {
  glm::vec3 before, from, to, after;
  float at_from = 0;  ///< length of the polyline up to `from`
};

/// A polyline without the points that are not finite, which cut it in two.
std::vector<std::vector<glm::vec3>> finite_runs(std::span<const glm::vec3> points);

/// The pieces of a polyline. Points that repeat the one before them, up to rounding in scene space,
/// are left out; where it ends in the point that it begins with it is closed. Points are finite.
/// Cost: O(points).
std::vector<LinePiece> line_pieces(std::span<const glm::vec3> points);

/// The points of a polyline that are needed to stay within `tolerance` of all of them; both ends
/// are kept, and at least every 256th point (D. Douglas, T. Peucker 1973, in runs of that length).
/// Points are finite. Cost: O(points), times 256 at worst.
std::vector<glm::vec3> simplified(std::span<const glm::vec3> points, float tolerance);

/// Lines on the surface, and what of them a view resolves: points that lie closer than pixels would
/// cost much and show nothing.
class LineSet {
 public:
  /// The pieces of one line among those of all.
  struct Range {
    std::uint32_t first = 0, count = 0;
    glm::vec3 colour{0};
  };

  void set(std::span<const Polyline> lines);

  /// Makes the pieces for this view, true to a fifth of a pixel; false: those there are will do.
  /// Cost: O(points), and that of simplified() where the zoom has changed by a factor of 2.
  bool fit(const Camera& camera);

  const std::vector<LinePiece>& pieces() const { return pieces_; }
  const std::vector<Range>& ranges() const { return ranges_; }

 private:
  struct Line {
    std::vector<std::vector<glm::vec3>> runs;  ///< of finite points
    glm::vec3 colour;
  };
  std::vector<Line> lines_;
  std::optional<int> level_;  ///< binary logarithm of the tolerance that pieces_ were made with
  std::vector<LinePiece> pieces_;
  std::vector<Range> ranges_;
};

}  // namespace geotherm::engine
