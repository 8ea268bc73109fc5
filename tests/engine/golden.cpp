// SPDX-License-Identifier: MIT
#include "tests/engine/golden.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

#include "tests/engine/measure.h"

namespace geotherm::test {
namespace {

using engine::Image;

/// libpng's description of an RGBA picture.
png_image description() {
  png_image png;
  std::memset(&png, 0, sizeof(png));
  png.version = PNG_IMAGE_VERSION;
  return png;
}

std::optional<Image> read_png(const std::string& path) {
  png_image png = description();
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) return std::nullopt;
  png.format = PNG_FORMAT_RGBA;
  Image image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) {
    return std::nullopt;
  }
  return image;
}

bool write_png(const std::string& path, const Image& image) {
  png_image png = description();
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGBA;
  return png_image_write_to_file(&png, path.c_str(), 0, image.pixels.data(), 0, nullptr) != 0;
}

bool is_to_be_kept() {
  const char* const wish = std::getenv("GEOTHERM_UPDATE_GOLDEN");
  return wish != nullptr && std::string_view(wish) == "1";
}

}  // namespace

void expect_golden(const Image& image, const std::string& name, double share) {
  constexpr int kTolerance = 2;  // of 255
  const std::string kept = std::string(GEOTHERM_GOLDEN_DIR) + "/" + name + ".png";
  if (is_to_be_kept()) {
    std::filesystem::create_directories(GEOTHERM_GOLDEN_DIR);
    ASSERT_TRUE(write_png(kept, image)) << kept;
    return;
  }
  const auto expected = read_png(kept);
  const double different = expected ? different_pixels(image, *expected, kTolerance) : 1;
  if (different <= share) return;
  const std::string actual = std::string(GEOTHERM_ACTUAL_DIR) + "/" + name + ".png";
  std::filesystem::create_directories(GEOTHERM_ACTUAL_DIR);
  const bool written = write_png(actual, image);
  ADD_FAILURE() << 100 * different << " % of the pixels differ from " << kept
                << (expected ? "" : ", which cannot be read") << "; what was drawn is in "
                << (written ? actual : "no file: " + actual + " cannot be written")
                << "; GEOTHERM_UPDATE_GOLDEN=1 keeps it";
}

}  // namespace geotherm::test
