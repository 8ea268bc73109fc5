// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/path/path_surface.h"

namespace geotherm {

/// A straight piece of a path through a row of faces. Points and faces are those of a PathSurface.
struct PathSegment {
  SurfacePoint from, to;
  std::vector<Index> faces;  ///< each shares an edge with the next; the first holds `from`
  double length = 0;         ///< in units of PathSurface::unit()

  /// Where an end is a vertex: the angle from the edge to the next corner of the first (last) face
  /// to the segment.
  double from_angle = 0, to_angle = 0;
};

/// Leaves out detours: faces that are entered and left through the same edge. Precondition:
/// neighbours share an edge or are the same face.
void cancel_detours(const PathSurface& surface, std::vector<Index>& faces);

/// The shortest path through the faces: segments that meet at vertices, none of length 0, so that
/// there are none where both ends are the same point. Cost: O(faces).
std::vector<PathSegment> pull_tight(const PathSurface& surface, const SurfacePoint& from,
                                    const SurfacePoint& to, std::vector<Index> faces);

double length_of(const std::vector<PathSegment>& segments);

/// Appends the points of a segment where it crosses edges, and the faces between; all but the first
/// point, which the path already has. Points nearer to a vertex than round-off are that vertex.
void append_points(const PathSurface& surface, const PathSegment& segment,
                   std::vector<SurfacePoint>& points, std::vector<Index>& faces);

}  // namespace geotherm
