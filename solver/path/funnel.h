// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace geotherm {

using Vec2 = Eigen::Vector2d;

/// String pulling: the shortest path from a point through a row of gates in the plane. Each gate
/// keeps one post of the one before it and replaces the other. The posts are numbered by the
/// caller, and so is the path's answer. Cost: O(posts) for a whole path.
/// Source: Lee, Preparata (1984), "Euclidean shortest paths in the presence of rectilinear
/// barriers".
class Funnel {
 public:
  /// `points`: of all posts and both ends; must outlive this.
  Funnel(const std::vector<Vec2>& points, int start, int left, int right);

  void add_left(int post);
  void add_right(int post);

  /// The path to an end behind the last gate: the numbers of start, posts it bends at, end.
  std::vector<int> path_to(int end);

 private:
  double turn(int a, int b, int c) const;  ///< > 0: c is left of a -> b

  const std::vector<Vec2>& points_;
  std::vector<int> deque_;   ///< left posts, outermost first, the apex, right posts
  std::vector<int> before_;  ///< the point before each on the shortest path to it
  std::size_t front_, back_, apex_;
};

}  // namespace geotherm
