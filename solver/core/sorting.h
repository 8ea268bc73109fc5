// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "geotherm/types.h"
#include "solver/core/memory.h"
#include "solver/core/parallel.h"

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

/// The place of each of the first `count` keys among them when they are sorted, equal ones in the
/// order they stand in. Counted instead of compared one by one: what lies round a vertex comes in
/// any order, and a processor guesses half of such comparisons wrong. Preconditions: the keys
/// behind `count` are kLastKey, the others are lower.
template <std::size_t kSize>
std::array<Index, kSize> ranks(const std::array<Index, kSize>& keys) {
  std::array<Index, kSize> rank{};
  for (std::size_t j = 0; j < kSize; ++j) {
    for (std::size_t i = 0; i < kSize; ++i) rank[i] += keys[j] < keys[i] + (j < i ? 1 : 0);
  }
  return rank;
}
inline constexpr Index kLastKey = std::numeric_limits<Index>::max() - 1;

/// Sorts numbers from 0 to kLastKey - 1, of which there are mostly about six.
inline void short_sort(Index* begin, Index* end) {
  const auto sort_few = [&]<std::size_t kSize>(std::array<Index, kSize> keys) {
    keys.fill(kLastKey);
    std::copy(begin, end, keys.begin());
    const auto rank = ranks(keys);
    for (std::ptrdiff_t i = 0; i < end - begin; ++i) begin[rank[i]] = keys[i];
  };
  if (end - begin <= 4) return sort_few(std::array<Index, 4>{});
  if (end - begin <= 8) return sort_few(std::array<Index, 8>{});
  if (end - begin <= 16) return sort_few(std::array<Index, 16>{});
  std::sort(begin, end);
}

/// Fills the compressed rows of a table whose lengths are not known before: add_row(i, list)
/// appends row i to `list`; start gets rows + 1 entries, and list those of all rows. Each thread
/// lists rows of its own, and what they found is put together. Exceptions are those of add_row and
/// std::bad_alloc.
template <class AddRow>
void list_rows(Index rows, int threads, const AddRow& add_row, std::vector<std::int64_t>& start,
               std::vector<Index>& list) {
  constexpr std::int64_t kGrain = 1 << 13;  // rows a thread must have to be worth starting
  const int pieces = piece_count(threads, rows, kGrain);
  start.assign(static_cast<std::size_t>(rows) + 1, 0);
  std::vector<std::vector<Index>> parts(static_cast<std::size_t>(pieces));
  for_pieces(pieces, rows, [&](int piece, std::int64_t begin, std::int64_t end) {
    std::vector<Index>& part = parts[static_cast<std::size_t>(piece)];
    constexpr std::int64_t kLikely = 7;  // entries a row, so that the list is seldom moved
    part.reserve(static_cast<std::size_t>(kLikely * (end - begin)));
    for (std::int64_t i = begin; i < end; ++i) {
      add_row(static_cast<Index>(i), part);
      start[static_cast<std::size_t>(i) + 1] = static_cast<std::int64_t>(part.size());
    }
  });
  if (pieces == 1) {
    list = std::move(parts.front());
    return;
  }
  std::vector<std::int64_t> before(parts.size() + 1, 0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    before[p + 1] = before[p] + static_cast<std::int64_t>(parts[p].size());
  }
  list.resize(static_cast<std::size_t>(before.back()));
  for_pieces(pieces, rows, [&](int piece, std::int64_t begin, std::int64_t end) {
    const auto p = static_cast<std::size_t>(piece);
    std::copy(parts[p].begin(), parts[p].end(), list.begin() + before[p]);
    for (std::int64_t i = begin; i < end; ++i) start[static_cast<std::size_t>(i) + 1] += before[p];
  });
}

/// Sets of the numbers 0 .. size - 1 that only ever join. The lowest member stands for its set.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// The lowest member of the set of `i`. Cost: O(log size) in the mean of all calls (paths are
  /// halved, sets are not ranked).
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// root() of every number.
  std::vector<Index> roots() && {
    for (Index& parent : parent_) parent = parent_[parent];  // which is lower, and a root by now
    return std::move(parent_);
  }

 private:
  std::vector<Index> parent_;
};

/// Calls body(i) for all i with bytes[i] == value, ascending; the body may change that byte. For
/// values that are rare: the rest is skipped a register at a time.
template <class Byte, class Body>
void for_each_with_value(const std::vector<Byte>& bytes, Byte value, Body&& body) {
  static_assert(sizeof(Byte) == 1);
  const Byte* const begin = bytes.data();
  const Byte* const end = begin + bytes.size();
  for (const Byte* at = begin; at != end; ++at) {
    at = static_cast<const Byte*>(std::memchr(at, value, static_cast<std::size_t>(end - at)));
    if (at == nullptr) return;
    body(static_cast<Index>(at - begin));
  }
}

/// The lowest 21 bits of a number, two zeros between each and the next: three such numbers make
/// a place on Morton's curve.
inline std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffu;
  x = (x | x << 16) & 0x001f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  x = (x | x << 2) & 0x1249249249249249u;
  return x;
}

}  // namespace geotherm
