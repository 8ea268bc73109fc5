// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace geotherm::engine {

/// Rows from the top, four bytes a pixel: red, green, blue (sRGB), alpha. Alpha is not multiplied
/// into the colours.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 * width * height

  const std::uint8_t* at(int x, int y) const {
    return pixels.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x));
  }
};

}  // namespace geotherm::engine
