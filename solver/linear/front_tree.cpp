// SPDX-License-Identifier: MIT
#include "solver/linear/front_tree.h"

#include <algorithm>
#include <limits>

#include "solver/core/parallel.h"
#include "solver/linear/front_tasks.h"

namespace geotherm {
namespace {

constexpr std::int64_t kFrontsAPiece = 2000;

/// Rows below the own ones of every front, ascending: each row of the matrix is walked up the tree
/// from its entries, and reaches the fronts in which it has a place.
std::vector<Index> rows_below(const SymmetricPattern& pattern, const FrontTree& fronts) {
  std::vector<std::int64_t> end(fronts.below_start.begin(), fronts.below_start.end() - 1);
  std::vector<Index> rows(static_cast<std::size_t>(fronts.below_start.back()));
  std::vector<Index> last_row(static_cast<std::size_t>(fronts.count()), kNoIndex);
  const std::vector<Index>& node_of_row = fronts.tree.node_of_row;
  for (Index row = 0; row < pattern.size(); ++row) {
    last_row[node_of_row[row]] = row;
    for (const Index neighbor : pattern.neighbors(row)) {
      if (neighbor > row) break;
      for (Index s = node_of_row[neighbor]; last_row[s] != row; s = fronts.tree.parent[s]) {
        last_row[s] = row;
        rows[end[s]++] = row;
      }
    }
  }
  return rows;
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

}  // namespace

std::int64_t FrontTree::bytes() const {
  return static_cast<std::int64_t>(
      sizeof(Index) * (3 * nodes.below.size() + tree.parent.size() + tree.node_of_row.size() +
                       place_in_parent.size() + entry_offset.size()) +
      sizeof(std::int64_t) * (below_start.size() + value_start.size() + entry_start.size()));
}

FrontTree build_front_tree(const SymmetricPattern& pattern, const ColumnCounts& counts,
                           int threads) {
  FrontTree out;
  out.nodes = find_supernodes(counts);
  out.tree.parent = out.nodes.parent;
  out.tree.node_of_row.resize(static_cast<std::size_t>(pattern.size()));
  out.is_leaf.assign(static_cast<std::size_t>(out.count()), 1);
  out.below_start.assign(1, 0);
  out.value_start.assign(1, 0);
  for (Index s = 0; s < out.count(); ++s) {
    const std::int64_t width = out.width(s), below = out.below(s);
    for (Index row = out.nodes.first[s]; row < out.nodes.first[s + 1]; ++row) {
      out.tree.node_of_row[row] = s;
    }
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
  for (Index column = 0; column < pattern.size(); ++column) {
    const double height = counts.below[column] + 1.0;
    out.operations += height * height;
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
  divide_into_tasks(out);
  return out;
}

}  // namespace geotherm
