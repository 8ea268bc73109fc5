// SPDX-License-Identifier: MIT
#include "geotherm/distance_method.h"

#include <utility>

namespace geotherm {

Result<DistanceResult> DistanceMethod::solve(const SourceSet& sources, const QueryOptions& query,
                                             const Progress& progress) const {
  auto results = solve_each({&sources, 1}, query, progress);
  if (!results) return results.error();
  return std::move(results->front());
}

}  // namespace geotherm
