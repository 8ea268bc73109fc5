// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/path/path_surface.h"

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

/// A row of faces, each sharing an edge with the next, laid out in one plane. All lengths are those
/// on the surface, in units of PathSurface::unit().
struct UnfoldedStrip {
  struct Corner {
    Index vertex;
    int first_gate, last_gate;  ///< the gates that it is a post of
  };
  struct Gate {
    int left, right;  ///< corners
  };
  std::vector<Vec2> points;               ///< of the corners; then the start, then the end
  std::vector<Corner> corners;            ///< faces + 2
  std::vector<std::array<int, 3>> faces;  ///< corners of each, in the order of the face
  std::vector<Gate> gates;                ///< gate k lies between faces k and k + 1

  int start() const { return static_cast<int>(corners.size()); }
  int end() const { return start() + 1; }
};

/// Precondition: the first face holds `from`, the last one `to`; neighbours share an edge, and no
/// edge follows itself. Cost: O(faces).
UnfoldedStrip unfold(const PathSurface& surface, const SurfacePoint& from, const SurfacePoint& to,
                     const std::vector<Index>& faces);

}  // namespace geotherm
