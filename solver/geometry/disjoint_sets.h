// SPDX-License-Identifier: MIT
#pragma once

#include <numeric>
#include <vector>

#include "solver/core/types.h"

namespace geotherm {

/// Sets of the numbers 0 .. size - 1 that only ever join (Tarjan 1975, with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// The member that stands for the set of `i`. Cost: nearly O(1).
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) { parent_[root(a)] = root(b); }

 private:
  std::vector<Index> parent_;
};

}  // namespace geotherm
