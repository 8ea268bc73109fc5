// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

namespace geotherm {

/// The upper half of a double: its sign, all of its exponent, and the first 20 bits of its
/// mantissa.
struct UpperHalf {
  std::uint32_t bits = 0;
};

inline double widened(double x) { return x; }
inline double widened(float x) { return x; }
inline double widened(UpperHalf x) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(x.bits) << 32);
}

/// To the nearest; `to` is overwritten.
inline void narrow(double x, double& to) { to = x; }
inline void narrow(double x, float& to) { to = static_cast<float>(x); }
inline void narrow(double x, UpperHalf& to) {
  constexpr std::uint64_t kHalf = 1ULL << 31;
  to.bits = static_cast<std::uint32_t>((std::bit_cast<std::uint64_t>(x) + kHalf) >> 32);
}

}  // namespace geotherm
