// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/path/path_segment.h"
#include "solver/path/surface_path.h"

namespace geotherm {

/// How often paths may still be shortened, and who watches.
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

/// The strip of two segments that meet at a vertex, led round it on its narrow side; nothing where
/// the path is as short there as it can be made. `closed`: neighbours of the vertex; edges to them
/// are not crossed.
std::optional<std::vector<Index>> strip_past(const PathSurface& surface, const PathSegment& in,
                                             const PathSegment& out,
                                             std::span<const Index> closed = {});

/// True when a length is less than another by more than round-off.
bool is_shorter(double length, double before);

/// Passes the vertices between segments until none is left that makes the chain shorter. Its ends
/// stay. Errors: those of the budget.
Result<void> straighten_bends(const PathSurface& surface, std::vector<PathSegment>& segments,
                              StepBudget& budget);

/// The path of segments, with points and faces of the file. `start`: where there are no segments.
SurfacePath path_of(const PathSurface& surface, const std::vector<PathSegment>& segments,
                    const SurfacePoint& start);

}  // namespace geotherm
