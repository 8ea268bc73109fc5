// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>

#include "geotherm/types.h"

namespace geotherm::test {

/// Random numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /// From 0 up to but not including 1.
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// 10 to a power between these.
  double power(double low, double high) { return std::pow(10.0, between(low, high)); }
  bool chance(double share) { return unit() < share; }
  /// From 0 to count - 1. Precondition: count > 0.
  Index below(std::size_t count) { return static_cast<Index>(engine_() % count); }
  Index from(Index low, Index high) {
    return low + below(static_cast<std::size_t>(high - low) + 1);
  }
  Vec3 in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  template <class List>
  auto pick(const List& among) {
    return among[static_cast<std::size_t>(below(std::size(among)))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace geotherm::test
