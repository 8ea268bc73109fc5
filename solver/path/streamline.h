// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "geotherm/error.h"
#include "geotherm/path.h"
#include "solver/path/path_surface.h"

namespace geotherm {

/// A function whose streamlines are followed downhill: linear on each face.
struct DescentField {
  std::span<const double> values;  ///< V, file order
  /// Values are ln u, and the function is -u: its streamlines are those of the heat method's
  /// X = -grad u / |grad u| backwards, followed also where u itself underflows.
  bool log_heat = false;
};

/// Where the steepest way down leads from a point: to a vertex in a straight line where there is
/// one, else across the face, so that the point's weights there change in proportion to `rates`.
struct Descent {
  double slope = 0;  ///< > 0, or nothing leads down
  Index face = kNoIndex;
  Index vertex = kNoIndex;
  std::array<double, 3> rates{};
};

/// The steepest way down from a point of the surface: into a face that holds it, along its edge
/// where the faces there lead into the edge, or along an edge of its vertex.
Descent steepest_descent(const PathSurface& surface, const DescentField& field,
                         const SurfacePoint& point);

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
