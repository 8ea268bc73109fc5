// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace geotherm::test {

/// What libpng reads back from a file's bytes.
struct PngContent {
  bool valid = false;
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> pixels;          ///< rows of `channels` bytes a pixel
  std::map<std::string, std::string> texts;  ///< of all text chunks
  bool srgb = false;
};

PngContent read_png(const std::string& bytes);

}  // namespace geotherm::test
