// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace geotherm {

/// Asks for as many numbers that lie so many bytes from these, into the second cache. They may lie
/// beyond the array. Never a function of its own: kernels of all instruction sets include it.
template <class T>
[[gnu::always_inline]] inline void prefetch_beside(const T* values, std::ptrdiff_t bytes,
                                                   std::ptrdiff_t count) {
  constexpr std::size_t kLine = 64;
  const auto first = reinterpret_cast<std::uintptr_t>(values) + static_cast<std::size_t>(bytes);
  const std::size_t size = static_cast<std::size_t>(count) * sizeof(T);
  for (std::size_t k = 0; k < size; k += kLine) {
    __builtin_prefetch(reinterpret_cast<const void*>(first + k), 0, 2);
  }
}

/// For a pass along memory that reads `count` numbers now: what the processor itself asks for ahead
/// ends with the page.
template <class T>
[[gnu::always_inline]] inline void prefetch_ahead(const T* now, std::ptrdiff_t count) {
  constexpr std::ptrdiff_t kAhead = 4096;
  prefetch_beside(now, kAhead, count);
}

}  // namespace geotherm
