// SPDX-License-Identifier: MIT
#include "solver/linear/column_counts.h"

#include "solver/linear/elimination_tree.h"

namespace geotherm {
namespace {

/// The columns in which one row of the factor has entries are a subtree of the elimination tree,
/// whose leaves are entries of the matrix. Leaves are met in postorder; each adds to the counts the
/// path up to where it meets the path of the leaf before.
class RowSubtrees {
 public:
  RowSubtrees(const std::vector<Index>& parent, const std::vector<Index>& order)
      : parent_(parent),
        first_descendant_(parent.size(), kNoIndex),
        last_first_(parent.size(), kNoIndex),
        last_leaf_(parent.size(), kNoIndex),
        set_(parent.size()) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      set_[k] = static_cast<Index>(k);
      for (Index j = order[k]; j != kNoIndex && first_descendant_[j] == kNoIndex; j = parent_[j]) {
        first_descendant_[j] = static_cast<Index>(k);
      }
    }
  }

  /// Whether no descendant of `column` has an entry in `row`; columns come in postorder.
  bool is_leaf(Index row, Index column) {
    if (first_descendant_[column] <= last_first_[row]) return false;
    last_first_[row] = first_descendant_[column];
    return true;
  }

  /// Where the path of this leaf meets that of the leaf of the row before; kNoIndex for the first.
  Index meeting(Index row, Index leaf) {
    const Index before = last_leaf_[row];
    last_leaf_[row] = leaf;
    if (before == kNoIndex) return kNoIndex;
    Index root = before;
    while (set_[root] != root) root = set_[root];
    for (Index j = before; j != root;) {  // path compression
      const Index next = set_[j];
      set_[j] = root;
      j = next;
    }
    return root;
  }

  /// All leaves of this column have been met.
  void finish(Index column) {
    if (parent_[column] != kNoIndex) set_[column] = parent_[column];
  }

 private:
  const std::vector<Index>& parent_;
  std::vector<Index> first_descendant_;  ///< place in postorder
  std::vector<Index> last_first_;        ///< per row: first descendant of its last leaf
  std::vector<Index> last_leaf_;         ///< per row
  std::vector<Index> set_;               ///< disjoint sets of finished columns under their ancestor
};

}  // namespace

ColumnCounts count_columns(const SymmetricPattern& pattern) {
  ColumnCounts out{elimination_parents(pattern), {}};
  const std::vector<Index>& parent = out.parent;
  const std::vector<Index> order = postorder(parent);
  RowSubtrees subtrees(parent, order);
  // Differences along the tree first, sums up the tree then. The diagonal is counted until the end.
  std::vector<Index>& count = out.below;
  count.assign(parent.size(), 1);
  for (std::size_t j = 0; j < parent.size(); ++j) {
    if (parent[j] != kNoIndex) count[parent[j]] = 0;  // no leaf of the tree
  }
  for (const Index column : order) {
    if (parent[column] != kNoIndex) --count[parent[column]];
    for (const Index row : pattern.neighbors(column)) {
      if (row < column || !subtrees.is_leaf(row, column)) continue;
      ++count[column];
      const Index meeting = subtrees.meeting(row, column);
      if (meeting != kNoIndex) --count[meeting];
    }
    subtrees.finish(column);
  }
  for (const Index column : order) {
    if (parent[column] != kNoIndex) count[parent[column]] += count[column];
  }
  for (Index& c : count) --c;
  return out;
}

}  // namespace geotherm
