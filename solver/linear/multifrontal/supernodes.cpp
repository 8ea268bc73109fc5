// SPDX-License-Identifier: MIT
#include <cstdint>

#include "solver/linear/multifrontal/front_tree.h"

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

}  // namespace

Supernodes find_supernodes(const ColumnCounts& counts) {
  return merge_last_children(merge_subtrees(strict_supernodes(counts)));
}

}  // namespace geotherm
