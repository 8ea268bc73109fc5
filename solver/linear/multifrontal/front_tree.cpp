// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/front_tree.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "solver/core/parallel.h"
#include "solver/linear/multifrontal/front_tasks.h"

namespace geotherm {
namespace {

/// What a front costs in every solve beside its entries, in entries: so many zeros may be stored to
/// have one front less. Measured at 30k to 4M faces.
constexpr double kFrontCost = 128;

/// Entries of a trapezoid of this height.
double entries(std::int64_t width, std::int64_t height) {
  return static_cast<double>(width * height - width * (width - 1) / 2);
}

/// Runs of columns with their parents, children before parents.
struct Draft {
  std::vector<Index> width, below, parent;

  Index count() const { return static_cast<Index>(width.size()); }
  void add(Index columns, Index rows_below, Index above) {
    width.push_back(columns);
    below.push_back(rows_below);
    parent.push_back(above);
  }
};

/// Columns whose patterns are the same but for their own rows.
Draft strict_supernodes(const ColumnCounts& counts) {
  const auto size = static_cast<Index>(counts.parent.size());
  std::vector<Index> last, of(counts.parent.size());
  for (Index j = 0; j < size; ++j) {
    const bool joins =
        j > 0 && counts.parent[j - 1] == j && counts.below[j - 1] == counts.below[j] + 1;
    if (!joins) last.push_back(j);
    last.back() = j;
    of[j] = static_cast<Index>(last.size()) - 1;
  }
  Draft out;
  Index begin = 0;
  for (const Index j : last) {
    const Index above = counts.parent[j];
    out.add(j + 1 - begin, counts.below[j], above == kNoIndex ? kNoIndex : of[above]);
    begin = j + 1;
  }
  return out;
}

/// Merges a whole subtree into one supernode where that costs less. Its columns are contiguous, and
/// all its rows below are among those of its root.
Draft merge_subtrees(const Draft& strict) {
  const auto count = static_cast<std::size_t>(strict.count());
  std::vector<Index> columns(strict.width);
  std::vector<double> cost(count, 0.0);  // of the subtree, as cheap as can be
  std::vector<char> merges(count, 0);
  for (Index s = 0; s < strict.count(); ++s) {
    const Index p = strict.parent[s];
    const double separate =
        cost[s] + kFrontCost + entries(strict.width[s], strict.width[s] + strict.below[s]);
    const double merged = kFrontCost + entries(columns[s], columns[s] + strict.below[s]);
    merges[s] = merged <= separate;
    cost[s] = merges[s] != 0 ? merged : separate;
    if (p == kNoIndex) continue;
    columns[p] += columns[s];
    cost[p] += cost[s];
  }
  // From the roots down: who is within a merged subtree.
  std::vector<char> within(count, 0);
  for (Index s = strict.count(); s-- > 0;) {
    const Index p = strict.parent[s];
    within[s] = p != kNoIndex && (merges[p] != 0 || within[p] != 0);
  }
  std::vector<Index> number(count, kNoIndex);
  Index kept = 0;
  for (Index s = 0; s < strict.count(); ++s) {
    if (within[s] == 0) number[s] = kept++;
  }
  Draft out;
  for (Index s = 0; s < strict.count(); ++s) {
    if (within[s] != 0) continue;
    const Index p = strict.parent[s];
    out.add(merges[s] != 0 ? columns[s] : strict.width[s], strict.below[s],
            p == kNoIndex ? kNoIndex : number[p]);
  }
  return out;
}

/// From the roots down, merges each supernode with the one before it, where that is its child and
/// the merger stores few zeros.
Supernodes merge_last_children(Draft draft) {
  std::vector<Index> taken_by(static_cast<std::size_t>(draft.count()), kNoIndex);
  const auto living = [&](Index s) {
    while (s != kNoIndex && taken_by[s] != kNoIndex) s = taken_by[s];
    return s;
  };
  std::vector<Index> parent = draft.parent;
  for (Index s = draft.count() - 1; s-- > 0;) {
    if (draft.parent[s] != s + 1) continue;
    const std::int64_t height = std::int64_t{draft.width[s + 1]} + draft.below[s + 1];
    const std::int64_t zeros = draft.width[s] * (height - draft.below[s]);
    if (static_cast<double>(zeros) > kFrontCost) continue;
    taken_by[s + 1] = s;
    draft.width[s] += draft.width[s + 1];
    draft.below[s] = draft.below[s + 1];
    parent[s] = parent[s + 1];
  }
  Supernodes out;
  std::vector<Index> number(taken_by.size(), kNoIndex);
  for (Index s = 0; s < draft.count(); ++s) {
    if (taken_by[s] != kNoIndex) continue;
    number[s] = out.count();
    out.first.push_back(out.first.back() + draft.width[s]);
    out.below.push_back(draft.below[s]);
  }
  for (Index s = 0; s < draft.count(); ++s) {
    if (taken_by[s] != kNoIndex) continue;
    const Index above = living(parent[s]);
    out.parent.push_back(above == kNoIndex ? kNoIndex : number[above]);
  }
  return out;
}

/// Columns whose patterns are the same but for their own rows, and beyond that narrow children
/// with their parents where that stores few zeros (Ashcraft, Grimes 1989): dense kernels want some
/// columns at a time. Precondition: columns in postorder. Cost: O(n).
Supernodes find_supernodes(const ColumnCounts& counts) {
  return merge_last_children(merge_subtrees(strict_supernodes(counts)));
}

/// Fronts that a thread takes at a time.
constexpr std::int64_t kFrontsAPiece = 2000;

/// Each row of the matrix is walked up the tree from its entries, and reaches the fronts in which
/// it has a place below their own rows: visit(front, row), rows ascending.
template <class Visit>
void walk_rows(const SymmetricPattern& pattern, const EliminationTree& tree, const Visit& visit) {
  std::vector<Index> last_row(tree.parent.size(), kNoIndex);
  for (Index row = 0; row < pattern.size(); ++row) {
    last_row[tree.node_of_row[row]] = row;
    for (const Index neighbor : pattern.neighbors(row)) {
      if (neighbor > row) break;
      for (Index s = tree.node_of_row[neighbor]; last_row[s] != row; s = tree.parent[s]) {
        last_row[s] = row;
        visit(s, row);
      }
    }
  }
}

/// Rows below the own ones of every front, ascending.
std::vector<Index> rows_below(const SymmetricPattern& pattern, const FrontTree& fronts) {
  std::vector<std::int64_t> end(fronts.below_start.begin(), fronts.below_start.end() - 1);
  std::vector<Index> rows(static_cast<std::size_t>(fronts.below_start.back()));
  walk_rows(pattern, fronts.tree, [&](Index s, Index row) { rows[end[s]++] = row; });
  return rows;
}

/// The tree with one node a supernode.
EliminationTree tree_of(const Supernodes& nodes) {
  EliminationTree tree{nodes.parent,
                       std::vector<Index>(static_cast<std::size_t>(nodes.first.back()))};
  for (Index s = 0; s < nodes.count(); ++s) {
    std::fill(tree.node_of_row.begin() + nodes.first[s],
              tree.node_of_row.begin() + nodes.first[s + 1], s);
  }
  return tree;
}

/// Places of the rows below front s among those of its parent: both lists ascend.
void find_places(const std::vector<Index>& rows, FrontTree& fronts, Index s) {
  const Index p = fronts.tree.parent[s];
  if (p == kNoIndex) return;
  const Index own_end = fronts.nodes.first[p + 1];
  const Index under = padded(fronts.width(p));
  const Index* candidate = rows.data() + fronts.below_start[p];
  const Index* const first = candidate;
  for (std::int64_t i = fronts.below_start[s]; i < fronts.below_start[s + 1]; ++i) {
    if (rows[i] < own_end) {
      fronts.place_in_parent[i] = rows[i] - fronts.nodes.first[p];
      continue;
    }
    while (*candidate != rows[i]) ++candidate;
    fronts.place_in_parent[i] = under + static_cast<Index>(candidate - first);
  }
}

/// Where the entries of front s go in its panel: slabs of rows, columns within.
void find_entries(const SymmetricPattern& pattern, const std::vector<Index>& rows,
                  FrontTree& fronts, Index s, std::vector<Index>& place_of_row) {
  const Index first = fronts.nodes.first[s], end = fronts.nodes.first[s + 1];
  const Index width = padded(end - first);
  for (std::int64_t i = fronts.below_start[s]; i < fronts.below_start[s + 1]; ++i) {
    place_of_row[rows[i]] = width + static_cast<Index>(i - fronts.below_start[s]);
  }
  const auto offset = [&](Index place, Index column) {
    return place / kSlab * kSlab * width + (column - first) * kSlab + place % kSlab;
  };
  for (Index column = first; column < end; ++column) {
    std::int64_t entry = fronts.entry_start[column];
    fronts.entry_offset[entry++] = offset(column - first, column);
    for (const Index row : pattern.neighbors(column)) {
      if (row < column) continue;
      fronts.entry_offset[entry++] = offset(row < end ? row - first : place_of_row[row], column);
    }
  }
}

/// Everything that follows from the supernodes. `operations`: of one factorisation.
FrontTree lay_out_fronts(const SymmetricPattern& pattern, Supernodes nodes, EliminationTree tree,
                         double operations, int threads, const FrontTree* earlier = nullptr) {
  FrontTree out;
  out.nodes = std::move(nodes);
  out.tree = std::move(tree);
  out.operations = operations;
  out.is_leaf.assign(static_cast<std::size_t>(out.count()), 1);
  out.below_start.assign(1, 0);
  out.value_start.assign(1, 0);
  for (Index s = 0; s < out.count(); ++s) {
    const std::int64_t width = out.width(s), below = out.below(s);
    if (out.tree.parent[s] != kNoIndex) out.is_leaf[out.tree.parent[s]] = 0;
    std::int64_t values = 0;
    for (std::int64_t column = 0; column < width; column += kSlab) {
      values += std::min<std::int64_t>(kSlab, width - column) * (width - column + below);
    }
    out.below_start.push_back(out.below_start.back() + below);
    out.value_start.push_back(out.value_start.back() + values);
    out.largest_panel =
        std::max(out.largest_panel, (padded(out.width(s)) + std::int64_t{padded(out.below(s))}) *
                                        padded(out.width(s)));
  }
  if (out.largest_panel > std::numeric_limits<Index>::max()) return out;
  out.entry_start.assign(1, 0);
  out.entry_start.reserve(pattern.start.size());
  for (Index column = 0; column < pattern.size(); ++column) {
    const auto neighbors = pattern.neighbors(column);
    const auto above = std::upper_bound(neighbors.begin(), neighbors.end(), column);
    out.entry_start.push_back(out.entry_start.back() + 1 + (neighbors.end() - above));
  }
  const std::vector<Index> rows = rows_below(pattern, out);
  out.place_in_parent.resize(rows.size());
  out.entry_offset.resize(static_cast<std::size_t>(out.entry_start.back()));
  parallel_for(threads, out.count(), kFrontsAPiece, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Index> place_of_row(static_cast<std::size_t>(pattern.size()));
    for (auto s = static_cast<Index>(begin); s < static_cast<Index>(end); ++s) {
      find_places(rows, out, s);
      find_entries(pattern, rows, out, s, place_of_row);
    }
  });
  divide_into_tasks(out, earlier);
  return out;
}

}  // namespace

FrontTree build_front_tree(const SymmetricPattern& pattern, const ColumnCounts& counts,
                           int threads) {
  double operations = 0;
  for (const Index below : counts.below) operations += (below + 1.0) * (below + 1.0);
  Supernodes nodes = find_supernodes(counts);
  EliminationTree tree = tree_of(nodes);
  return lay_out_fronts(pattern, std::move(nodes), std::move(tree), operations, threads);
}

FrontTree build_front_tree(const SymmetricPattern& pattern, const NodeOrder& order, int threads,
                           const FrontTree* earlier) {
  Supernodes nodes{order.first, std::vector<Index>(order.parent.size(), 0), order.parent};
  EliminationTree tree = tree_of(nodes);
  walk_rows(pattern, tree, [&](Index s, Index) { ++nodes.below[s]; });
  double operations = 0;
  for (Index s = 0; s < nodes.count(); ++s) {
    for (Index height = nodes.below[s] + 1; height <= nodes.below[s] + nodes.width(s); ++height) {
      operations += static_cast<double>(height) * height;
    }
  }
  return lay_out_fronts(pattern, std::move(nodes), std::move(tree), operations, threads, earlier);
}

}  // namespace geotherm
