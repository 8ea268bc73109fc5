// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/core/types.h"

namespace geotherm {

/// The elimination tree of a factor over its nodes (columns, or supernodes: runs of columns).
/// Children come before parents.
struct EliminationTree {
  std::vector<Index> parent;       ///< one a node; kNoIndex at roots
  std::vector<Index> node_of_row;  ///< one a row

  /// The nodes that a right side with these nonzero rows can reach: all ancestors, ascending.
  /// Cost: the length of the answer, times a logarithm (Gilbert, Peierls 1988, for trees).
  std::vector<Index> path(std::span<const Index> rows) const;
};

}  // namespace geotherm
