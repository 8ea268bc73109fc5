// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace geotherm {

/// Asks for what a pass along memory reads next but for 4 kB, as many numbers as it reads now: what
/// the processor itself asks for ahead ends with the page, and with four streams at once.
template <class T>
inline void prefetch_ahead(const T* now, std::ptrdiff_t count) {
  constexpr std::ptrdiff_t kAhead = 4096, kLine = 64;
  const char* const begin = reinterpret_cast<const char*>(now) + kAhead;
  const std::ptrdiff_t bytes = count * static_cast<std::ptrdiff_t>(sizeof(T));
  for (std::ptrdiff_t at = 0; at < bytes; at += kLine) __builtin_prefetch(begin + at, 0, 2);
}

}  // namespace geotherm
