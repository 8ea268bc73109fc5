// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "solver/directions/tangent_fans.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// The direction of every side of an intrinsic triangulation.
struct FlippedDirections {
  /// 3F: the direction of each side at the vertex where it begins, in that vertex's frame
  /// (TangentFrame), and at the vertex where it ends, seen from there.
  std::vector<double> at_begin, at_end;
  /// From angles of corners to directions, of each vertex: V, and inserted ones, whose frames are
  /// of the triangle that they were put in.
  std::vector<double> scale;
  /// The first vertex without a frame that its neighbours share: of several fans, at an edge with
  /// three faces, or where orientations disagree. All else is empty then.
  std::optional<Index> broken;
};

/// Follows the directions of the fans, which are of the faces of the mesh, through the edits that
/// led to `flipped`. Cost: O(F + edits).
FlippedDirections flip_directions(const IntrinsicSurface& flipped, const TangentFans& fans);

}  // namespace geotherm
