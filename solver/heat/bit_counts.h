// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace geotherm {

/// In how many masks each of 16 bits is set: all bits of a mask are counted at once.
class BitCounts {
 public:
  void add(std::uint16_t mask) {
    for (std::size_t k = 0; k < kBits; ++k) {
      short_[k] = static_cast<std::uint16_t>(short_[k] + ((mask & 1U << k) != 0 ? 1 : 0));
    }
    if (++added_ == std::numeric_limits<std::uint16_t>::max()) flush();
  }
  std::int64_t of(std::size_t bit) {
    flush();
    return long_[bit];
  }

 private:
  static constexpr std::size_t kBits = 16;
  void flush() {
    for (std::size_t k = 0; k < kBits; ++k) long_[k] += std::exchange(short_[k], 0);
    added_ = 0;
  }
  std::array<std::uint16_t, kBits> short_{};  ///< since the last flush: a register of all
  std::array<std::int64_t, kBits> long_{};
  std::uint16_t added_ = 0;
};

}  // namespace geotherm
