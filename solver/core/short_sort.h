// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "geotherm/types.h"

namespace geotherm {

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

}  // namespace geotherm
