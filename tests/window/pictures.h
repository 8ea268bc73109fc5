// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/target.h"

namespace geotherm::test {

/// Rows from the top, three bytes a pixel.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// A .png file. Empty where it is none.
Picture picture_in(const std::string& path);
/// A part of the screen.
Picture part_of(const engine::Image& screen, int x, int y, int width, int height);

/// The share of pixels that differ by more than the rounding of colours explains; 1 where the sizes
/// differ or there is no picture.
double share_that_differs(const Picture& a, const Picture& b);

/// What pictures of one scene may differ by: as of the pictures that are kept for comparison.
inline constexpr double kSamePicture = 0.005;

}  // namespace geotherm::test
