// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geotherm/types.h"

namespace geotherm::io {

/// Gives equal positions one number, in order of first appearance. Equal means every bit equal,
/// with -0 taken as 0. A hash table with open addressing; cost O(1) per corner on average.
class VertexWelder {
 public:
  explicit VertexWelder(std::size_t corner_guess) { grow(std::bit_ceil(corner_guess / 3 + 16)); }

  Index add(Vec3 p) {
    p.array() += 0.0;  // -0 becomes 0
    if (2 * positions_.size() >= slots_.size()) grow(2 * slots_.size());
    Index& slot = find(p);
    if (slot == kNoIndex) {
      slot = static_cast<Index>(positions_.size());
      positions_.push_back(p);
    }
    return slot;
  }

  std::vector<Vec3> take_positions() { return std::move(positions_); }

 private:
  static std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis) {
      h = (h ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9e3779b97f4a7c15u;
      h ^= h >> 32;
    }
    return h;
  }

  /// The slot of an equal position, or the empty one where it belongs.
  Index& find(const Vec3& p) {
    std::size_t i = hash(p) & (slots_.size() - 1);
    while (slots_[i] != kNoIndex && positions_[static_cast<std::size_t>(slots_[i])] != p) {
      i = (i + 1) & (slots_.size() - 1);
    }
    return slots_[i];
  }

  void grow(std::size_t size) {
    slots_.assign(size, kNoIndex);
    for (std::size_t v = 0; v < positions_.size(); ++v) find(positions_[v]) = static_cast<Index>(v);
  }

  std::vector<Vec3> positions_;
  std::vector<Index> slots_;  ///< the size is a power of two
};

}  // namespace geotherm::io
