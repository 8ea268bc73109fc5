// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"
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

/// Limits the number of steps in which a path is shortened, and reports progress.
class StepBudget {
 public:
  StepBudget(const PathSurface& surface, const Progress& progress);

  /// Errors: kBudgetEnded, kCancelled.
  Result<void> spend();

 private:
  const Progress& progress_;
  std::size_t most_, spent_ = 0;
};

/// The segments of a path that is pulled tight between the vertices it runs through. `path`: points
/// and faces of the file, two points at least. Errors: kBadInput (a piece outside of its face).
Result<std::vector<PathSegment>> tight_segments(const PathSurface& surface,
                                                const SurfacePath& path);

/// The strip of two segments that meet at a vertex, led round the vertex on its narrow side;
/// nothing where the path cannot be made shorter there. `closed`: neighbours of the vertex whose
/// edges to it must not be crossed.
std::optional<std::vector<Index>> strip_past(const PathSurface& surface, const PathSegment& in,
                                             const PathSegment& out,
                                             std::span<const Index> closed = {});

/// True when a length is less than another by more than round-off.
bool is_shorter(double length, double before);

/// Leads the chain of segments round the vertices at which it bends, until no such step makes it
/// shorter. Its ends stay. Errors: those of the budget.
Result<void> straighten_bends(const PathSurface& surface, std::vector<PathSegment>& segments,
                              StepBudget& budget);

/// The path that the segments form, with points and faces of the file. `start`: the point of a path
/// without segments.
SurfacePath path_of(const PathSurface& surface, const std::vector<PathSegment>& segments,
                    const SurfacePoint& start);

/// Shortens a path until no piece of it can be made shorter: straight across faces, and through a
/// vertex only where there are pi or more on every side (saddles, boundaries). Both ends stay; a
/// closed path is shortened all round and may end as a single point, of length 0. The result is a
/// locally shortest path, never longer than the given one, and the shortest of all where that was
/// near enough to it. Strips of faces are unfolded and pulled tight, and a vertex at which the path
/// bends is passed on its narrow side, each step making it shorter (Xin, Wang 2007, "Efficiently
/// determining a locally exact shortest path on polyhedral surfaces"). A closed path without a
/// vertex is the minimum of a convex function of the place where it is cut open. `start`: points
/// and faces of the file. Errors: kBadInput (no points, pieces outside of their faces),
/// kBudgetEnded, kCancelled, kOutOfMemory.
Result<SurfacePath> shorten(const PathSurface& surface, const SurfacePath& start,
                            bool search = false, const Progress& progress = {});

}  // namespace geotherm
