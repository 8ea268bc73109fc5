// SPDX-License-Identifier: MIT
// TetGen's pair of files. Each reader takes the bytes of FileBytes (with its padding) and throws
// ReadFailure or std::bad_alloc.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "solver/mesh/io/raw_elements.h"

namespace geotherm::io {

/// The vertices of a .node file, and the number that its first one has: 0 or 1.
struct TetgenNodes {
  std::vector<Vec3> positions;
  std::int64_t first = 0;
};
TetgenNodes read_node(std::string_view text);
RawElements read_ele(std::string_view text, TetgenNodes nodes);

}  // namespace geotherm::io
