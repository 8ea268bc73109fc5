// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "geotherm/types.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"

namespace geotherm {

/// Cells whose corners all lie in one range of rows, such as the faces of a mesh: what they add to
/// their corners meets nothing that another range's cells add, so that ranges can be walked side by
/// side.
struct RowRange {
  Index first_row, end_row;
  Index first_cell, end_cell;
};

/// Cuts the rows into ranges, whatever the number of threads, and brings the cells that cross from
/// one to another to the end; `sorted`, the numbers of all cells by their lowest rows, stays in
/// order otherwise. low_high(cell): its lowest and highest rows.
template <class LowHigh>
std::vector<RowRange> part_by_rows(Index size, RawVector<Index>& sorted, const LowHigh& low_high) {
  // Some 0.1 ms of work for a pass over the cells of a range, several times what it takes to start
  // a thread. Eliminated one after the other, its rows are a patch or a few: 2 to 5 % of the cells
  // cross. More ranges would make more cells cross without keeping more cores busy.
  constexpr Index kRowsOfRange = 8192, kMaxRanges = 32;
  const Index count = std::clamp<Index>(size / kRowsOfRange, 1, kMaxRanges);
  std::vector<RowRange> ranges;
  RawVector<Index> parted, crossing;
  parted.reserve(sorted.size());
  std::size_t next = 0;
  for (Index r = 0; r < count; ++r) {
    RowRange range{static_cast<Index>(std::int64_t{size} * r / count),
                   static_cast<Index>(std::int64_t{size} * (r + 1) / count),
                   static_cast<Index>(parted.size()), 0};
    for (; next < sorted.size(); ++next) {
      const auto [low, high] = low_high(sorted[next]);
      if (low >= range.end_row) break;
      (high < range.end_row ? parted : crossing).push_back(sorted[next]);
    }
    range.end_cell = static_cast<Index>(parted.size());
    ranges.push_back(range);
  }
  parted.insert(parted.end(), crossing.begin(), crossing.end());
  sorted = std::move(parted);
  return ranges;
}

/// Calls body(range) for all of them, on as many threads as get `grain` each. Where what crosses
/// follows, each row has its sum in one order, with any number of threads.
template <class Body>
void for_ranges(const std::vector<RowRange>& ranges, int threads, std::int64_t grain,
                const Body& body) {
  parallel_each(threads, std::ssize(ranges), grain,
                [&](std::int64_t r) { body(ranges[static_cast<std::size_t>(r)]); });
}

}  // namespace geotherm
