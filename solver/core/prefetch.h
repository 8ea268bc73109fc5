// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace geotherm {

/// Asks for what a pass along memory reads 4 kB from now, as many numbers as it reads now: what the
/// processor itself asks for ahead ends with the page. May reach beyond the end.
template <class T>
inline void prefetch_ahead(const T* now, std::ptrdiff_t count) {
  constexpr std::uintptr_t kAhead = 4096, kLine = 64;
  const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(now) + kAhead;
  const std::uintptr_t end = begin + static_cast<std::uintptr_t>(count) * sizeof(T);
  for (std::uintptr_t at = begin; at < end; at += kLine) {
    __builtin_prefetch(reinterpret_cast<const void*>(at), 0, 2);
  }
}

}  // namespace geotherm
