// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "solver/directions/tangent_fans.h"
#include "solver/geometry/edit.h"

namespace geotherm {

/// The intrinsic Delaunay triangulation of a surface, with the direction of every side.
struct FlippedDirections {
  IntrinsicMesh mesh;  ///< after flips
  /// 3F: the direction of each side at the vertex where it begins, in that vertex's frame
  /// (TangentFrame), and at the vertex where it ends, seen from there.
  std::vector<double> at_begin, at_end;
  std::vector<double> scale;  ///< V: from angles of corners to directions
  std::vector<Edit> flips;    ///< from the faces of the surface to these
  /// The first vertex without a frame that its neighbours share: of several fans, at an edge with
  /// three faces, or where orientations disagree. The directions are of use where there is none.
  std::optional<Index> broken;
};

/// Follows the directions of the fans through the flips. Errors: kCancelled. Cost: O(F + flips).
Result<FlippedDirections> flip_with_directions(const WaveSurface& surface, const TangentFans& fans,
                                               const Progress& progress);

}  // namespace geotherm
