// SPDX-License-Identifier: MIT
#include <png.h>

#include <array>

#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/input_file.h"

namespace geotherm::io {
namespace {

/// An image of libpng that is freed.
struct PngImage {
  PngImage() { png.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&png); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;

  png_image png{};
};

}  // namespace

RawGrid read_png(std::string_view bytes) {
  PngImage image;
  if (png_image_begin_read_from_memory(&image.png, bytes.data(), bytes.size()) == 0) {
    throw ReadFailure{"the picture cannot be read: " + std::string(image.png.message)};
  }
  RawGrid grid;
  grid.size = {image.png.width, image.png.height, 1};
  const std::size_t count = count_samples(grid.size);
  // A byte of deflate unpacks to no more than 1032, and a byte holds 8 samples at most.
  constexpr std::size_t kMaxPixels = 8 * 1032;
  if (count / kMaxPixels > bytes.size()) {
    throw ReadFailure{"there are to be " + std::to_string(image.png.width) + " x " +
                      std::to_string(image.png.height) + " pixels, but the file has only " +
                      std::to_string(bytes.size()) + " bytes"};
  }
  // Behind a palette are the numbers of its colours: libpng takes those beyond it as black.
  const bool palette = (image.png.format & PNG_FORMAT_FLAG_COLORMAP) != 0;
  image.png.format = PNG_FORMAT_GRAY | (palette ? PNG_FORMAT_FLAG_COLORMAP : 0U);
  std::vector<unsigned char> pixels(count);
  std::array<unsigned char, 256> colours{};
  const png_color white = {255, 255, 255};  // behind what is transparent
  if (png_image_finish_read(&image.png, &white, pixels.data(), 0, colours.data()) == 0) {
    throw ReadFailure{"the picture cannot be read: " + std::string(image.png.message)};
  }
  for (std::size_t i = 0; i < count && palette; ++i) {
    if (pixels[i] >= image.png.colormap_entries) {
      throw ReadFailure{"the pixel in column " + std::to_string(i % image.png.width) + " of row " +
                        std::to_string(i / image.png.width) + " has the colour " +
                        std::to_string(pixels[i]) + " of a palette of " +
                        std::to_string(image.png.colormap_entries)};
    }
    pixels[i] = colours[pixels[i]];
  }
  if (palette) {
    grid.detail = ", of a palette of " + std::to_string(image.png.colormap_entries) + " colours";
  }
  grid.values.assign(pixels.begin(), pixels.end());
  grid.type = RawGrid::Values::kPixels;
  // The first row is the top, and y points up: the lowest row of pixels is at 0.
  grid.spacing[1] = -1;
  grid.origin[1] = static_cast<double>(grid.size[1] - 1);
  return grid;
}

}  // namespace geotherm::io
