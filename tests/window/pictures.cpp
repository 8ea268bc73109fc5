// SPDX-License-Identifier: MIT
#include "tests/window/pictures.h"

#include <cstdlib>

#include "tests/app/png_reader.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

constexpr int kRounding = 2;  ///< of 255

std::size_t index(int x, int y, int width, int channels) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(x)) *
         static_cast<std::size_t>(channels);
}

}  // namespace

Picture picture_in(const std::string& path) {
  const PngContent png = read_png(bytes_of(path));
  Picture picture;
  if (!png.valid || png.channels < 3) return picture;
  picture.width = png.width;
  picture.height = png.height;
  for (int y = 0; y < png.height; ++y) {
    for (int x = 0; x < png.width; ++x) {
      const auto* const pixel = png.pixels.data() + index(x, y, png.width, png.channels);
      picture.pixels.insert(picture.pixels.end(), pixel, pixel + 3);
    }
  }
  return picture;
}

Picture part_of(const engine::Image& screen, int x, int y, int width, int height) {
  Picture picture;
  if (x + width > screen.width || y + height > screen.height) return picture;
  picture.width = width;
  picture.height = height;
  for (int row = y; row < y + height; ++row) {
    for (int column = x; column < x + width; ++column) {
      const auto* const pixel = screen.at(column, row);
      picture.pixels.insert(picture.pixels.end(), pixel, pixel + 3);
    }
  }
  return picture;
}

double share_that_differs(const Picture& a, const Picture& b) {
  if (a.pixels.empty() || a.width != b.width || a.height != b.height) return 1;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 3) {
    bool differs = false;
    for (std::size_t k = i; k < i + 3; ++k) {
      differs |= std::abs(a.pixels[k] - b.pixels[k]) > kRounding;
    }
    if (differs) ++differing;
  }
  return static_cast<double>(differing) / (static_cast<double>(a.pixels.size()) / 3);
}

}  // namespace geotherm::test
