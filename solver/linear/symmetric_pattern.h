// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/core/types.h"

namespace geotherm {

/// The nonzero pattern of a symmetric matrix as a graph: row i has a diagonal entry and one at
/// every neighbour of i. Neighbours are sorted; the graph is symmetric and has no loops.
struct SymmetricPattern {
  std::vector<std::int64_t> start = {0};  ///< n + 1
  std::vector<Index> neighbor;            ///< both directions of every edge

  Index size() const { return static_cast<Index>(start.size()) - 1; }
  std::span<const Index> neighbors(Index i) const {
    return {neighbor.data() + start[i], neighbor.data() + start[i + 1]};
  }
};

/// The pattern of any operator on these faces: vertices that share a face. n = size >= every
/// corner + 1. Cost: O(F).
SymmetricPattern pattern_of_faces(Index size, std::span<const Face> faces);

/// The same graph with vertex order[k] renamed k. Precondition: order is a permutation. Cost: O(n).
SymmetricPattern permuted(const SymmetricPattern& pattern, std::span<const Index> order);

/// position[order[k]] = k.
std::vector<Index> inverse_permutation(std::span<const Index> order);

/// A number that differs (but for bad luck) between different patterns.
std::uint64_t pattern_hash(const SymmetricPattern& pattern);

/// Connected component of every vertex, numbered by first appearance.
struct Components {
  std::vector<Index> of;  ///< n
  Index count = 0;
};
Components connected_components(const SymmetricPattern& pattern);

}  // namespace geotherm
