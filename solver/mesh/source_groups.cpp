// SPDX-License-Identifier: MIT
#include <unordered_map>

#include "geotherm/sources.h"
#include "solver/core/disjoint_sets.h"

namespace geotherm {

SourceGroups source_groups(const SourceSet& sources) {
  const auto points = static_cast<Index>(sources.points.size());
  const auto edges = static_cast<Index>(sources.edges.size());
  DisjointSets sets(sources.points.size() + sources.edges.size());
  std::unordered_map<Index, Index> end_of;  // vertex to an edge that ends there
  for (Index e = 0; e < edges; ++e) {
    for (const Index v : sources.edges[e]) {
      const auto [at, fresh] = end_of.try_emplace(v, points + e);
      if (!fresh) sets.join(points + e, at->second);
    }
  }
  for (Index i = 0; i < points; ++i) {
    if (!sources.points[i].is_vertex()) continue;
    const auto at = end_of.find(sources.points[i].vertex);
    if (at != end_of.end()) sets.join(i, at->second);
  }
  SourceGroups groups;
  std::unordered_map<Index, Index> number;
  const auto group_of = [&](Index i) {
    const auto [at, fresh] = number.try_emplace(sets.root(i), groups.count);
    groups.count += fresh;
    return at->second;
  };
  for (Index i = 0; i < points; ++i) groups.of_point.push_back(group_of(i));
  for (Index e = 0; e < edges; ++e) {
    groups.of_edge.push_back(group_of(points + e));
  }
  return groups;
}

}  // namespace geotherm
