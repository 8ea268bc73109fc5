// SPDX-License-Identifier: MIT
#include <numeric>
#include <unordered_map>

#include "solver/mesh/surface_point.h"

namespace geotherm {
namespace {

/// Sets of numbers that grow together.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

SourceGroups source_groups(const SourceSet& sources) {
  const std::size_t points = sources.points.size();
  Sets sets(points + sources.edges.size());
  std::unordered_map<Index, std::size_t> end_of;  // vertex to an edge that ends there
  for (std::size_t e = 0; e < sources.edges.size(); ++e) {
    for (const Index v : sources.edges[e]) {
      const auto [at, fresh] = end_of.try_emplace(v, points + e);
      if (!fresh) sets.join(points + e, at->second);
    }
  }
  for (std::size_t i = 0; i < points; ++i) {
    if (!sources.points[i].is_vertex()) continue;
    const auto at = end_of.find(sources.points[i].vertex);
    if (at != end_of.end()) sets.join(i, at->second);
  }
  SourceGroups groups;
  std::unordered_map<std::size_t, Index> number;
  const auto group_of = [&](std::size_t i) {
    const auto [at, fresh] = number.try_emplace(sets.root(i), groups.count);
    groups.count += fresh;
    return at->second;
  };
  for (std::size_t i = 0; i < points; ++i) groups.of_point.push_back(group_of(i));
  for (std::size_t e = 0; e < sources.edges.size(); ++e) {
    groups.of_edge.push_back(group_of(points + e));
  }
  return groups;
}

}  // namespace geotherm
