// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
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
  /// The path of the rows with a flag, for many such rows. Cost: O(rows).
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

/// An elimination order that follows a tree: its nodes one after the other, children before
/// parents, each subtree contiguous.
struct NodeOrder {
  std::vector<Index> order;   ///< order[k]: the vertex eliminated k-th
  std::vector<Index> first;   ///< nodes + 1: place of each node's first vertex in `order`
  std::vector<Index> parent;  ///< nodes: kNoIndex at roots
};

/// How the rows of a pattern in a NodeOrder stand in an earlier one with as many rows and the same
/// nodes. Rows that have not changed keep their order among them.
struct EarlierRows {
  std::span<const Index> number;  ///< n: of each row in the earlier order
  std::span<const char> changed;  ///< n: EarlierFactor::changed
};

/// Keeps an elimination order where a graph has got other edges, or vertices: each vertex stays in
/// its node of the earlier tree, unless an edge joins two branches; then the end in the higher
/// numbered one rises to the node where the branches meet. A factor of the graph in this order has
/// entries only where a row's node is an ancestor of the column's. Nodes without vertices are left
/// out.
///
/// `parent`: the earlier tree, a postorder. `order`: the earlier order, which vertices of one node
/// keep among them; new ones follow. `node`: of every vertex, kNoIndex for a new one, which
/// begins in the lowest node of its neighbours; changed to what they have in the end. `faces`: the
/// graph as triangles, whose corners are vertices; a new one in none of them is left out. Empty
/// where an edge joins two trees, or a face has new vertices alone, far from others. Cost: O(F),
/// and the depth of the tree for each vertex that rises.
std::optional<NodeOrder> order_along(std::span<const Index> parent, std::span<const Index> order,
                                     std::vector<Index>& node, std::span<const Face> faces);

/// How large the columns of a Cholesky factor will be.
struct ColumnCounts {
  std::vector<Index> parent;  ///< n: the row of a column's first entry below the diagonal; kNoIndex
  std::vector<Index> below;   ///< n: entries below the diagonal
};

/// Counts the entries of each column of the factor of a matrix with this pattern, eliminated in the
/// order of its numbers. Cost: nearly O(entries of the pattern), however many the factor has
/// (Gilbert, Ng, Peyton 1994).
ColumnCounts count_columns(const SymmetricPattern& pattern);

}  // namespace geotherm
