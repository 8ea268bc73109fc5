// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "solver/directions/tangent_fans.h"
#include "solver/geometry/intrinsic_surface.h"

namespace geotherm {

/// The direction of every side of an intrinsic Delaunay triangulation.
struct FlippedDirections {
  /// 3F: the direction of each side at the vertex where it begins, in that vertex's frame
  /// (TangentFrame), and at the vertex where it ends, seen from there.
  std::vector<double> at_begin, at_end;
  std::vector<double> scale;  ///< V: from angles of corners to directions
  /// The first vertex without a frame that its neighbours share: of several fans, at an edge with
  /// three faces, or where orientations disagree. The directions are of use where there is none.
  std::optional<Index> broken;
};

/// Follows the directions of the fans, which are of the faces of the mesh, through the flips that
/// led to `flipped`. Precondition: it has no cover and no inserted vertices. Cost: O(F + flips).
FlippedDirections flip_directions(const IntrinsicSurface& flipped, const TangentFans& fans);

}  // namespace geotherm
