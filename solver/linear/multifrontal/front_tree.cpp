// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/front_tree.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "solver/core/memory.h"
#include "solver/core/parallel.h"
#include "solver/linear/multifrontal/front_tasks.h"

namespace geotherm {
namespace {

/// Fronts that a thread takes at a time.
constexpr std::int64_t kFrontsAPiece = 2000;

/// The neighbours of a column that come after it, ascending.
std::span<const Index> later(const SymmetricPattern& pattern, Index column) {
  const auto all = pattern.neighbors(column);
  return {std::upper_bound(all.begin(), all.end(), column), all.end()};
}
std::span<const Index> later(const LowerPattern& pattern, Index column) {
  return {pattern.row.data() + pattern.start[column] + 1,
          pattern.row.data() + pattern.start[column + 1]};
}

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
void find_places(std::span<const Index> rows, FrontTree& fronts, Index s) {
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
template <class Pattern>
void find_entries(const Pattern& pattern, std::span<const Index> rows, FrontTree& fronts, Index s,
                  std::vector<Index>& place_of_row) {
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
    for (const Index row : later(pattern, column)) {
      fronts.entry_offset[entry++] = offset(row < end ? row - first : place_of_row[row], column);
    }
  }
}

/// Operations of one factorisation.
double operations_of(const Supernodes& nodes) {
  double operations = 0;
  for (Index s = 0; s < nodes.count(); ++s) {
    for (Index height = nodes.below[s] + 1; height <= nodes.below[s] + nodes.width(s); ++height) {
      operations += static_cast<double>(height) * height;
    }
  }
  return operations;
}

/// The sizes that follow from the supernodes, and room for places and entries; none where
/// largest_panel is beyond what an Index counts.
template <class Pattern>
FrontTree measure_fronts(const Pattern& pattern, Supernodes nodes, EliminationTree tree) {
  FrontTree out;
  out.nodes = std::move(nodes);
  out.tree = std::move(tree);
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
  out.entry_start.reserve(static_cast<std::size_t>(out.size()) + 1);
  for (Index column = 0; column < out.size(); ++column) {
    out.entry_start.push_back(out.entry_start.back() + 1 + std::ssize(later(pattern, column)));
  }
  out.place_in_parent.resize(static_cast<std::size_t>(out.below_start.back()));
  out.entry_offset.resize(static_cast<std::size_t>(out.entry_start.back()));
  return out;
}

/// Everything that follows from the supernodes. `operations`: of one factorisation.
FrontTree lay_out_fronts(const SymmetricPattern& pattern, Supernodes nodes, EliminationTree tree,
                         double operations, int threads, const FrontTree* earlier = nullptr) {
  FrontTree out = measure_fronts(pattern, std::move(nodes), std::move(tree));
  out.operations = operations;
  if (out.largest_panel > std::numeric_limits<Index>::max()) return out;
  const std::vector<Index> rows = rows_below(pattern, out);
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

/// What stays of an earlier tree whose nodes are the same.
class FrontUpdate {
 public:
  FrontUpdate(const LowerPattern& lower, const NodeOrder& order, const FrontTree& earlier,
              const EarlierRows& rows)
      : lower_(lower),
        earlier_(earlier),
        number_now_(inverse_permutation(rows.number)),
        changed_(order.parent.size(), 0),
        listed_(order.parent.size()) {
    Supernodes nodes{order.first, earlier.nodes.below, order.parent};
    EliminationTree tree = tree_of(nodes);
    for (std::size_t k = 0; k < rows.changed.size(); ++k) {
      if (rows.changed[k] == 0) continue;
      changed_[tree.node_of_row[k]] = 1;
      changed_[earlier.tree.node_of_row[rows.number[k]]] = 1;
    }
    for (Index s = 0; s < nodes.count(); ++s) {
      if (changed_[s] != 0 && nodes.parent[s] != kNoIndex) changed_[nodes.parent[s]] = 1;
    }
    list_rows(nodes);
    out_ = measure_fronts(lower, std::move(nodes), std::move(tree));
  }

  FrontTree finish(int threads) && {
    out_.operations = operations_of(out_.nodes);
    if (out_.largest_panel > std::numeric_limits<Index>::max()) return std::move(out_);
    RawVector<Index> rows(static_cast<std::size_t>(out_.below_start.back()));
    for (Index s = 0; s < out_.count(); ++s) {
      std::ranges::copy(listed_[s], rows.begin() + out_.below_start[s]);
    }
    parallel_for(threads, out_.count(), kFrontsAPiece, [&](std::int64_t begin, std::int64_t end) {
      std::vector<Index> place_of_row(static_cast<std::size_t>(out_.size()));
      for (auto s = static_cast<Index>(begin); s < static_cast<Index>(end); ++s) {
        if (is_listed(s)) {
          find_places(rows, out_, s);
        } else {
          copy_part(earlier_.place_in_parent, earlier_.below_start, s, s + 1, out_.place_in_parent,
                    out_.below_start[s]);
        }
        if (changed_[s] != 0) {
          find_entries(lower_, rows, out_, s, place_of_row);
        } else {
          copy_part(earlier_.entry_offset, earlier_.entry_start, earlier_.nodes.first[s],
                    earlier_.nodes.first[s + 1], out_.entry_offset,
                    out_.entry_start[out_.nodes.first[s]]);
        }
      }
    });
    divide_into_tasks(out_, &earlier_);
    return std::move(out_);
  }

 private:
  /// Whether the rows below a front are needed: it or its parent has changed.
  bool is_listed(Index s) const {
    const Index p = earlier_.nodes.parent[s];
    return changed_[s] != 0 || (p != kNoIndex && changed_[p] != 0);
  }

  static void copy_part(const std::vector<Index>& from, const std::vector<std::int64_t>& start,
                        Index first, Index end, std::vector<Index>& to, std::int64_t at) {
    std::copy(from.begin() + start[first], from.begin() + start[end], to.begin() + at);
  }

  /// The rows below each listed front, as they were numbered: those that places in parents say.
  std::vector<std::vector<Index>> rows_before() const {
    std::vector<std::vector<Index>> rows(listed_.size());
    for (Index s = earlier_.count(); s-- > 0;) {
      const Index p = earlier_.nodes.parent[s];
      if (p == kNoIndex || !is_listed(s)) continue;
      const Index under = padded(earlier_.width(p));
      for (Index i = 0; i < earlier_.below(s); ++i) {
        const Index place = earlier_.places_in_parent(s)[i];
        rows[s].push_back(place < under ? earlier_.nodes.first[p] + place : rows[p][place - under]);
      }
    }
    return rows;
  }

  /// Below a front that has changed are those of its children and of its own entries.
  void list_rows(Supernodes& nodes) {
    std::vector<std::vector<Index>> before = rows_before();
    for (Index s = 0; s < nodes.count(); ++s) {
      std::vector<Index>& rows = listed_[s];
      if (changed_[s] == 0) {
        for (const Index row : before[s]) rows.push_back(number_now_[row]);
      } else {
        for (Index column = nodes.first[s]; column < nodes.first[s + 1]; ++column) {
          const auto entries = later(lower_, column);
          rows.insert(rows.end(), entries.begin(), entries.end());
        }
        std::ranges::sort(rows);
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        rows.erase(rows.begin(), std::ranges::lower_bound(rows, nodes.first[s + 1]));
        nodes.below[s] = static_cast<Index>(rows.size());
      }
      const Index p = nodes.parent[s];
      if (p == kNoIndex || changed_[p] == 0) continue;
      listed_[p].insert(listed_[p].end(), rows.begin(), rows.end());
    }
  }

  const LowerPattern& lower_;
  const FrontTree& earlier_;
  const std::vector<Index> number_now_;     ///< of each earlier row
  std::vector<char> changed_;               ///< S: a row in it or below it has
  std::vector<std::vector<Index>> listed_;  ///< S: rows below, where they are needed
  FrontTree out_;
};

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
  const double operations = operations_of(nodes);
  return lay_out_fronts(pattern, std::move(nodes), std::move(tree), operations, threads, earlier);
}

FrontTree update_front_tree(const LowerPattern& lower, const NodeOrder& order,
                            const FrontTree& earlier, const EarlierRows& rows, int threads) {
  return FrontUpdate(lower, order, earlier, rows).finish(threads);
}

}  // namespace geotherm
