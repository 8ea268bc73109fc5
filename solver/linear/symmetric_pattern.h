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

/// The same graph with vertex order[k] renamed k. Precondition: order is a permutation. Cost: O(n),
/// by all threads.
SymmetricPattern permuted(const SymmetricPattern& pattern, std::span<const Index> order,
                          int threads = 1);

/// The lower triangle of permuted(pattern, order), as LowerMatrix has it: by columns, the diagonal
/// first, rows ascending.
struct LowerPattern {
  std::vector<std::int64_t> start;  ///< n + 1
  std::vector<Index> row;
};
LowerPattern permuted_lower(const SymmetricPattern& pattern, std::span<const Index> order,
                            int threads = 1);

/// position[order[k]] = k.
std::vector<Index> inverse_permutation(std::span<const Index> order, int threads = 1);

/// A number that differs (but for bad luck) between different patterns; the lower triangle of a
/// pattern has that of the pattern.
std::uint64_t pattern_hash(const SymmetricPattern& pattern, int threads = 1);
std::uint64_t pattern_hash(const LowerPattern& lower, int threads = 1);

/// Connected component of every vertex, numbered by first appearance.
struct Components {
  std::vector<Index> of;  ///< n
  Index count = 0;
};
Components connected_components(const SymmetricPattern& pattern);

}  // namespace geotherm
