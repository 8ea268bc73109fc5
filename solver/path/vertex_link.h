// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/path/path_surface.h"

namespace geotherm {

/// A direction at a vertex: a face there, and the angle to its edge to the next corner.
struct LinkPoint {
  Index face;
  double angle;
};

/// The way round a vertex from one direction to another.
struct LinkRoute {
  double angle = 0;
  std::vector<Index> faces;  ///< from the face of the first direction to that of the second
};

/// The narrowest way round the vertex, through any faces that share edges there: the shortest path
/// in the link, whose nodes are the edges at the vertex and whose arcs are the faces with their
/// angles. Where it is narrower than pi, a path that comes from one direction and leaves in the
/// other can be shortened on that side; where no way is, the path is straight there, whatever
/// number of faces meet. Nothing where every way is `limit` or more. Cost: O(n log n) for n faces.
/// `closed`: neighbours of the vertex; no way leads across the edges to them.
std::optional<LinkRoute> narrowest_way(const PathSurface& surface, Index vertex,
                                       const LinkPoint& from, const LinkPoint& to, double limit,
                                       std::span<const Index> closed = {});

}  // namespace geotherm
