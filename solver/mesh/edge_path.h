// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/error.h"
#include "solver/mesh/edge_table.h"

namespace geotherm {

/// The vertices and edges of a mesh as a graph to walk on. Immutable; keeps a view of `positions`.
class EdgeGraph {
 public:
  EdgeGraph(std::span<const Vec3> positions, const EdgeTable& edges);

  /// True when a mesh edge joins the two.
  bool adjacent(Index a, Index b) const;

  /// The shortest path along edges, both ends included: the vertices in order (one when
  /// from == to). Errors: kBadInput where no path leads from one to the other.
  /// Cost: Dijkstra's, guided by the straight distance to `to`.
  Result<std::vector<Index>> shortest_path(Index from, Index to) const;

 private:
  std::span<const Index> neighbours(Index v) const {
    return {neighbours_.data() + start_[v], neighbours_.data() + start_[v + 1]};
  }

  std::span<const Vec3> positions_;
  std::vector<std::size_t> start_;
  std::vector<Index> neighbours_;
};

}  // namespace geotherm
