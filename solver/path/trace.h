// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/error.h"
#include "geotherm/path.h"
#include "solver/path/descent.h"
#include "solver/path/path_surface.h"

namespace geotherm {

/// A streamline that has come to its goal.
struct Streamline {
  SurfacePath path;    ///< points and faces of the file
  bool stuck = false;  ///< nothing led down before the goal, and it went on along edges
};

/// The line of steepest descent from `start` to `goal`: straight across faces, along edges into
/// which both faces lead, and at a vertex into the face or edge that falls most. It ends with a
/// straight piece as soon as it is in a face with the goal. Where nothing leads down (a minimum
/// that is no goal, a plateau) it goes on along the shortest path of edges, and `stuck` says so.
/// Points: of the file. Errors: kBadInput (a point not on the surface, no way from one to the
/// other). Cost: O(faces crossed), and a pass over the edges where it is stuck.
Result<Streamline> trace_streamline(const PathSurface& surface, const DescentField& field,
                                    const SurfacePoint& start, const SurfacePoint& goal);

/// The shortest path along edges, from each point to the corners of its faces and from there on.
/// Errors: kBadInput (as above).
Result<SurfacePath> edge_path(const PathSurface& surface, const SurfacePoint& start,
                              const SurfacePoint& goal);

}  // namespace geotherm
