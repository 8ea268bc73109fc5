// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"
#include "solver/path/path_segment.h"

namespace geotherm {

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

}  // namespace geotherm
