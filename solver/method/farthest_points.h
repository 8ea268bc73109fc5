// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "geotherm/many.h"

namespace geotherm {

/// Who answers where samples are chosen: several at a time, such as processes of which each solves
/// for one vertex.
struct SampleCrew {
  std::size_t at_once = 1;  ///< vertices that it is asked about, at most; >= 1
  /// An answer for each vertex, in their order; of those but the first the distances alone matter.
  std::function<Result<std::vector<DistanceResult>>(
      std::span<const Index> vertices, const QueryOptions& query, const Progress& progress)>
      solve;
};

/// farthest_points() by a crew, with the same answer. Beside the next sample it is asked about the
/// vertices that will be the next ones, if no vertex that the samples before them come nearer to
/// stays farther: those at which none of these can lower the distance, by straight lines. What was
/// guessed wrong is asked for again when its turn comes.
Result<FarthestPoints> farthest_points_by(const SampleCrew& crew, const TriangleMesh& mesh,
                                          Index count, const FarthestOptions& options = {},
                                          const Progress& progress = {});

}  // namespace geotherm
