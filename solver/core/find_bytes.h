// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

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

}  // namespace geotherm
