// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geotherm/types.h"

namespace geotherm {

/// Side k of face f joins its corners k and (k + 1) % 3; it is numbered 3 f + k.
using Side = std::int32_t;
inline constexpr Side kNoSide = -1;

inline Index face_of(Side side) { return side / 3; }
inline int corner_of(Side side) { return side % 3; }

/// Without branches: round a vertex k is anything, and a processor would guess it wrong.
inline int next_corner(int k) { return (1 << k) & 3; }
inline int previous_corner(int k) { return (0b010010 >> (2 * k)) & 3; }

}  // namespace geotherm
