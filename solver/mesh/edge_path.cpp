// SPDX-License-Identifier: MIT
#include "solver/mesh/edge_path.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <string>
#include <utility>

namespace geotherm {

EdgeGraph::EdgeGraph(std::span<const Vec3> positions, const EdgeTable& edges)
    : positions_(positions), start_(positions.size() + 1, 0) {
  for (Index e = 0; e < edges.edge_count(); ++e) {
    ++start_[edges.low(e) + 1];
    ++start_[edges.high(e) + 1];
  }
  for (std::size_t v = 0; v < positions.size(); ++v) start_[v + 1] += start_[v];
  neighbours_.resize(start_.back());
  std::vector<std::size_t> cursor(start_.begin(), start_.end() - 1);
  for (Index e = 0; e < edges.edge_count(); ++e) {
    neighbours_[cursor[edges.low(e)]++] = edges.high(e);
    neighbours_[cursor[edges.high(e)]++] = edges.low(e);
  }
}

bool EdgeGraph::adjacent(Index a, Index b) const {
  const auto around = neighbours(a);
  return std::find(around.begin(), around.end(), b) != around.end();
}

Result<std::vector<Index>> EdgeGraph::shortest_path(Index from, Index to) const {
  using Entry = std::pair<double, Index>;  // least possible length through the vertex
  const auto straight = [this](Index a, Index b) {
    return (positions_[a] - positions_[b]).stableNorm();
  };
  std::vector<double> length(positions_.size(), std::numeric_limits<double>::infinity());
  std::vector<Index> before(positions_.size(), kNoIndex);
  std::vector<char> done(positions_.size(), 0);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  length[from] = 0;
  queue.emplace(straight(from, to), from);
  while (!queue.empty() && !done[to]) {
    const Index v = queue.top().second;
    queue.pop();
    if (std::exchange(done[v], 1)) continue;
    for (const Index w : neighbours(v)) {
      const double through = length[v] + straight(v, w);
      if (done[w] || !(through < length[w])) continue;
      length[w] = through;
      before[w] = v;
      queue.emplace(through + straight(w, to), w);
    }
  }
  if (!done[to]) {
    return Error{ErrorCode::kBadInput, "no edges lead from vertex " + std::to_string(from) +
                                           " to vertex " + std::to_string(to) +
                                           "; they lie in different components"};
  }
  std::vector<Index> path;
  for (Index v = to; v != kNoIndex; v = before[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace geotherm
