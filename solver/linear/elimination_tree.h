// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/types.h"
#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// The elimination tree of a factor over its nodes (columns, or supernodes: runs of columns).
/// Children come before parents.
struct EliminationTree {
  std::vector<Index> parent;       ///< one a node; kNoIndex at roots
  std::vector<Index> node_of_row;  ///< one a row

  /// The nodes that a right side with these nonzero rows can reach: all ancestors, ascending.
  /// Cost: the length of the answer, times a logarithm (Gilbert, Peierls 1988, for trees).
  std::vector<Index> path(std::span<const Index> rows) const;
  /// The same for rows with a flag: for many of them. Cost: O(rows).
  std::vector<Index> path_of_flags(std::span<const char> rows) const;
};

/// The elimination tree of a matrix with this pattern, eliminated in the order of its numbers: the
/// parent of a column is the row of its first entry below the diagonal, kNoIndex where it has none.
/// Cost: nearly O(entries of the pattern), whatever the factor's (Liu 1986, with path compression).
std::vector<Index> elimination_parents(const SymmetricPattern& pattern);

/// order[k]: the node that comes k-th when every subtree is contiguous and children come before
/// their parent, siblings in the order of their numbers. Precondition: parents have larger numbers.
/// Cost: O(n).
std::vector<Index> postorder(std::span<const Index> parent);

/// How large the columns of a Cholesky factor will be.
struct ColumnCounts {
  std::vector<Index> parent;  ///< n: the row of a column's first entry below the diagonal; kNoIndex
  std::vector<Index> below;   ///< n: entries below the diagonal
};

/// Of a matrix with this pattern, eliminated in the order of its numbers. Cost: nearly O(entries of
/// the pattern), whatever the factor's (Gilbert, Ng, Peyton 1994).
ColumnCounts count_columns(const SymmetricPattern& pattern);

}  // namespace geotherm
