// SPDX-License-Identifier: MIT
#include "solver/method/reach.h"

#include <string>
#include <utility>

#include "solver/core/text.h"

namespace geotherm {

Result<void> check_reach(const Reach& reach, Index vertices) {
  if (!(reach.max_distance > 0)) {
    return Error{ErrorCode::kBadInput,
                 "the largest distance is " + number_text(reach.max_distance),
                 {"give a length above 0"}};
  }
  for (std::size_t i = 0; i < reach.targets.size(); ++i) {
    const Index v = reach.targets[i];
    if (v >= 0 && v < vertices) continue;
    return Error{
        ErrorCode::kBadInput,
        "target " + std::to_string(i) + " is vertex " + std::to_string(v) + ", which is not there",
        {"vertices are 0 to " + std::to_string(vertices - 1)}};
  }
  return {};
}

void keep_reach(const Reach& reach, DistanceResult& result) {
  std::vector<double>& distances = result.distances;
  std::vector<Index>& nearest = result.nearest_source;
  if (reach.max_distance < kUnreached) {
    for (std::size_t v = 0; v < distances.size(); ++v) {
      if (distances[v] <= reach.max_distance) continue;
      distances[v] = kUnreached;
      if (!nearest.empty()) nearest[v] = kNoIndex;
    }
  }
  if (!reach.targets.empty()) {
    result.vertices = reach.targets;
  } else if (reach.sparse) {
    for (std::size_t v = 0; v < distances.size(); ++v) {
      if (distances[v] < kUnreached) result.vertices.push_back(static_cast<Index>(v));
    }
  } else {
    return;
  }
  const auto pick = [&result](auto& values) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> kept;
    kept.reserve(result.vertices.size());
    for (const Index v : result.vertices) kept.push_back(values[static_cast<std::size_t>(v)]);
    values = std::move(kept);
  };
  pick(distances);
  pick(nearest);
}

}  // namespace geotherm
