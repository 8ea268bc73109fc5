// SPDX-License-Identifier: MIT
#include "tests/app/png_reader.h"

#include <png.h>

#include <csetjmp>
#include <cstring>

namespace geotherm::test {
namespace {

struct PngBytes {
  const std::string& bytes;
  std::size_t at = 0;
  std::vector<png_bytep> rows;
};

void take_bytes(png_structp png, png_bytep into, png_size_t size) {
  PngBytes& source = *static_cast<PngBytes*>(png_get_io_ptr(png));
  if (source.bytes.size() - source.at < size) png_error(png, "the file ends early");
  std::memcpy(into, source.bytes.data() + source.at, size);
  source.at += size;
}

/// Left by longjmp where libpng fails: whatever has a destructor belongs to the caller.
bool read_into(png_structp png, png_infop info, PngBytes& source, PngContent& content) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &source, take_bytes);
  png_read_info(png, info);
  content.width = static_cast<int>(png_get_image_width(png, info));
  content.height = static_cast<int>(png_get_image_height(png, info));
  content.channels = png_get_channels(png, info);
  const std::size_t row = png_get_rowbytes(png, info);
  content.pixels.resize(row * static_cast<std::size_t>(content.height));
  for (int y = 0; y < content.height; ++y) {
    source.rows.push_back(content.pixels.data() + row * static_cast<std::size_t>(y));
  }
  png_read_image(png, source.rows.data());
  png_read_end(png, info);
  content.srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
  return true;
}

}  // namespace

PngContent read_png(const std::string& bytes) {
  PngContent content;
  PngBytes source{bytes, 0, {}};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  content.valid = read_into(png, info, source, content);
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i) content.texts[texts[i].key] = texts[i].text;
  png_destroy_read_struct(&png, &info, nullptr);
  return content;
}

}  // namespace geotherm::test
