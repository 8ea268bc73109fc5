// SPDX-License-Identifier: MIT
#include "solver/linear/supernodes.h"

#include <cstdint>

namespace geotherm {
namespace {

/// How readily supernodes are merged: up to so many columns together, this share of all entries
/// may be zeros. Every solve reads the zeros, every front saves the passing on of an update;
/// measured at 100k to 4M faces.
struct Relaxation {
  Index columns;
  double zeros;
};
constexpr Relaxation kRelaxation[] = {{8, 0.5}, {24, 0.25}, {64, 0.06}};
constexpr double kZerosOfWide = 0.02;

double zeros_allowed(Index columns) {
  for (const Relaxation& step : kRelaxation) {
    if (columns <= step.columns) return step.zeros;
  }
  return kZerosOfWide;
}

struct Draft {
  std::vector<Index> width, height;  ///< height: of the first column, the diagonal included
  std::vector<std::int64_t> zeros;
};

/// Entries of a trapezoid of this height.
double entries(std::int64_t width, std::int64_t height) {
  return static_cast<double>(width * height - width * (width - 1) / 2);
}

}  // namespace

Supernodes find_supernodes(const ColumnCounts& counts) {
  const auto size = static_cast<Index>(counts.parent.size());
  // Strict supernodes first.
  std::vector<Index> first, of(counts.parent.size());
  for (Index j = 0; j < size; ++j) {
    const bool joins =
        j > 0 && counts.parent[j - 1] == j && counts.below[j - 1] == counts.below[j] + 1;
    if (!joins) first.push_back(j);
    of[j] = static_cast<Index>(first.size()) - 1;
  }
  const auto strict = static_cast<Index>(first.size());
  first.push_back(size);
  std::vector<Index> parent(static_cast<std::size_t>(strict));
  Draft draft;
  for (Index s = 0; s < strict; ++s) {
    const Index above = counts.parent[first[s + 1] - 1];
    parent[s] = above == kNoIndex ? kNoIndex : of[above];
    draft.width.push_back(first[s + 1] - first[s]);
    draft.height.push_back(counts.below[first[s]] + 1);
    draft.zeros.push_back(0);
  }
  // From the roots down: each takes the supernode behind it in, where that is its parent.
  std::vector<Index> taken_by(static_cast<std::size_t>(strict), kNoIndex);
  const auto living = [&](Index s) {
    while (s != kNoIndex && taken_by[s] != kNoIndex) s = taken_by[s];
    return s;
  };
  for (Index s = strict - 1; s-- > 0;) {
    if (parent[s] == kNoIndex || parent[s] != s + 1) continue;
    const std::int64_t width = draft.width[s], above = draft.width[s + 1];
    const std::int64_t height = width + draft.height[s + 1];
    const std::int64_t zeros =
        draft.zeros[s] + draft.zeros[s + 1] + width * (height - draft.height[s]);
    const auto columns = static_cast<Index>(width + above);
    if (static_cast<double>(zeros) > zeros_allowed(columns) * entries(columns, height)) {
      continue;
    }
    taken_by[s + 1] = s;
    draft.width[s] = columns;
    draft.height[s] = static_cast<Index>(height);
    draft.zeros[s] = zeros;
  }
  Supernodes out;
  std::vector<Index> number(static_cast<std::size_t>(strict), kNoIndex);
  Index columns = 0;
  for (Index s = 0; s < strict; ++s) {
    if (taken_by[s] != kNoIndex) continue;
    number[s] = out.count();
    columns += draft.width[s];
    out.first.push_back(columns);
    out.below.push_back(draft.height[s] - draft.width[s]);
  }
  for (Index s = 0; s < out.count(); ++s) {
    const Index above = counts.parent[out.first[s + 1] - 1];
    out.parent.push_back(above == kNoIndex ? kNoIndex : number[living(of[above])]);
  }
  return out;
}

}  // namespace geotherm
