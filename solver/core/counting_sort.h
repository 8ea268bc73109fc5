// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geotherm/types.h"
#include "solver/core/parallel.h"
#include "solver/core/raw_vector.h"

namespace geotherm {

/// Groups entries by key, by all threads; entries of one group stay in order.
/// emit(item, put) calls put(key, entry) for each entry of one of the `items`, in the order of
/// their items; keys are in [0, keys). It is called twice for each. start[key] gets the place of
/// the first entry of each group, start[keys] their number (below 2^32). Cost: O(items + keys).
template <class Entry, class Emit>
RawVector<Entry> counting_sort(std::size_t items, std::size_t keys, int threads, const Emit& emit,
                               std::vector<std::uint32_t>& start) {
  // Each thread counts on its own: of more than these the counts would cost more than the items.
  constexpr int kMaxPieces = 8;
  constexpr std::int64_t kGrain = 1 << 14;  // items a thread must have to be worth starting
  const auto count = static_cast<std::int64_t>(items);
  const int pieces = piece_count(std::min(threads, kMaxPieces), count, kGrain);
  std::vector<std::vector<std::uint32_t>> cursors(static_cast<std::size_t>(pieces));
  for (auto& cursor : cursors) cursor.resize(keys);
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::uint32_t* const counts = cursors[static_cast<std::size_t>(piece)].data();
    for (std::int64_t i = begin; i < end; ++i) {
      emit(static_cast<std::size_t>(i), [counts](Index key, Entry) { ++counts[key]; });
    }
  });
  // A piece writes in each group behind the pieces before it.
  start.resize(keys + 1);
  std::uint32_t filled = 0;
  for (std::size_t key = 0; key < keys; ++key) {
    start[key] = filled;
    for (auto& cursor : cursors) {
      const std::uint32_t here = cursor[key];
      cursor[key] = filled;
      filled += here;
    }
  }
  start[keys] = filled;
  RawVector<Entry> sorted(filled);
  for_pieces(pieces, count, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::uint32_t* const cursor = cursors[static_cast<std::size_t>(piece)].data();
    for (std::int64_t i = begin; i < end; ++i) {
      emit(static_cast<std::size_t>(i),
           [&sorted, cursor](Index key, Entry entry) { sorted[cursor[key]++] = entry; });
    }
  });
  return sorted;
}

/// The numbers of `items` sorted by key(item), in [0, keys); those with the same key in order.
template <class Key>
RawVector<Index> sorted_by_key(std::size_t items, std::size_t keys, int threads, const Key& key) {
  std::vector<std::uint32_t> start;
  const auto emit = [&key](std::size_t i, const auto& put) { put(key(i), static_cast<Index>(i)); };
  return counting_sort<Index>(items, keys, threads, emit, start);
}

}  // namespace geotherm
