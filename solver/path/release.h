// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"
#include "solver/path/leg.h"

namespace geotherm {

/// How often paths may still be shortened, and who watches.
class ShortenBudget {
 public:
  ShortenBudget(const PathSurface& surface, const Progress& progress);

  /// Errors: kBudgetEnded, kCancelled.
  Result<void> spend();

 private:
  const Progress& progress_;
  std::size_t most_, spent_ = 0;
};

/// The legs of a path that is pulled tight between the vertices it runs through. `path`: points and
/// faces of the file, two points at least. Errors: kBadInput (a piece outside of its face).
Result<std::vector<Leg>> tight_legs(const PathSurface& surface, const SurfacePath& path);

/// The strip of two legs that meet at a vertex, led round it on its narrow side; nothing where the
/// path is as short there as it can be made.
/// `closed`: neighbours of the vertex; edges to them are not crossed.
std::optional<std::vector<Index>> strip_past(const PathSurface& surface, const Leg& in,
                                             const Leg& out, std::span<const Index> closed = {});

/// True when a length is less than another by more than round-off.
bool is_shorter(double length, double before);

/// Passes the vertices between legs until none is left that makes the chain shorter. Its ends stay.
/// Errors: those of the budget.
Result<void> release_bends(const PathSurface& surface, std::vector<Leg>& legs,
                           ShortenBudget& budget);

/// The path of legs, with points and faces of the file. `start`: where there are no legs.
SurfacePath path_of(const PathSurface& surface, const std::vector<Leg>& legs,
                    const SurfacePoint& start);

}  // namespace geotherm
