// SPDX-License-Identifier: MIT
#include "app/picture/png_file.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <new>
#include <vector>

#include "app/text/text.h"

namespace geotherm::app {
namespace {

/// Pictures are smooth shades: a higher level costs seconds at 8192 x 8192 and saves a few per
/// cent.
constexpr int kCompression = 4;

/// What one file is written from and into. libpng leaves its functions by longjmp, which runs no
/// destructors: all that has one lives here, outside the function that is left.
struct PngWriter {
  const DrawnPicture& picture;
  bool opaque = true;
  png_uint_32 dots_per_metre = 0;  ///< 0: not said
  std::vector<png_text> texts;
  std::vector<std::string> words;  ///< what `texts` points to
  std::string bytes;
  std::string failure;
  bool memory_ended = false;  ///< ours or libpng's
};

PngWriter& writer_of(png_structp png) { return *static_cast<PngWriter*>(png_get_io_ptr(png)); }

extern "C" {

void append_png_bytes(png_structp png, png_bytep data, png_size_t size) {
  bool done = false;
  try {
    writer_of(png).bytes.append(reinterpret_cast<const char*>(data), size);
    done = true;
  } catch (const std::bad_alloc&) {  // must not pass through libpng
  }
  if (done) return;
  writer_of(png).memory_ended = true;
  png_error(png, "out of memory");
}

void flush_png_bytes(png_structp) {}

[[noreturn]] void fail_png(png_structp png, png_const_charp message) {
  try {
    static_cast<PngWriter*>(png_get_error_ptr(png))->failure = message;
  } catch (const std::bad_alloc&) {  // the failure itself is told by the jump
  }
  png_longjmp(png, 1);
}

/// libpng reports a lack of memory in words alone, so it asks here for its own.
png_voidp allocate_for_png(png_structp png, png_alloc_size_t size) {
  void* const block = ::operator new(size, std::nothrow);
  if (block == nullptr) static_cast<PngWriter*>(png_get_mem_ptr(png))->memory_ended = true;
  return block;
}

void free_for_png(png_structp, png_voidp block) { ::operator delete(block); }

void ignore_png_warning(png_structp, png_const_charp) {}

}  // extern "C"

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<signed char>(c) >= 0; });
}

void add_texts(PngWriter& writer, std::span<const FileText> texts) {
  writer.words.reserve(2 * texts.size());  // `texts` holds pointers to these
  for (const FileText& text : texts) {
    std::string& keyword = writer.words.emplace_back(text.keyword);
    std::string& value = writer.words.emplace_back(one_line(text.text));
    png_text chunk{};
    chunk.compression = is_ascii(value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    chunk.key = keyword.data();
    chunk.text = value.data();
    (chunk.compression == PNG_TEXT_COMPRESSION_NONE ? chunk.text_length : chunk.itxt_length) =
        value.size();
    writer.texts.push_back(chunk);
  }
}

/// Nothing here may need a destructor: see PngWriter.
bool write_png(png_structp png, png_infop info, PngWriter& writer) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const auto width = static_cast<png_uint_32>(writer.picture.width);
  const auto height = static_cast<png_uint_32>(writer.picture.height);
  png_set_write_fn(png, &writer, append_png_bytes, flush_png_bytes);
  png_set_compression_level(png, kCompression);
  png_set_IHDR(png, info, width, height, 8,
               writer.opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (writer.dots_per_metre > 0) {
    png_set_pHYs(png, info, writer.dots_per_metre, writer.dots_per_metre, PNG_RESOLUTION_METER);
  }
  png_set_text(png, info, writer.texts.data(), static_cast<int>(writer.texts.size()));
  png_write_info(png, info);
  if (writer.opaque) png_set_filler(png, 0, PNG_FILLER_AFTER);  // leaves every fourth byte out
  for (png_uint_32 y = 0; y < height; ++y) {
    png_write_row(png, writer.picture.pixels.data() + std::size_t{4} * width * y);
  }
  png_write_end(png, nullptr);
  return true;
}

bool is_opaque(const DrawnPicture& picture) {
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) {
    if (picture.pixels[i] != 255) return false;
  }
  return true;
}

}  // namespace

Result<std::string> png_bytes(const DrawnPicture& picture, std::span<const FileText> texts,
                              std::optional<int> dpi) {
  constexpr double kInch = 0.0254;  // metres
  const auto dots = static_cast<png_uint_32>(std::lround(dpi.value_or(0) / kInch));
  PngWriter writer{picture, is_opaque(picture), dots, {}, {}, {}, {}};
  add_texts(writer, texts);
  png_structp png =
      png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &writer, fail_png, ignore_png_warning,
                                &writer, allocate_for_png, free_for_png);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const bool written = info != nullptr && write_png(png, info, writer);
  png_destroy_write_struct(&png, &info);
  if (written) return std::move(writer.bytes);
  const std::string size =
      std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels";
  if (writer.memory_ended) {
    return Error{ErrorCode::kOutOfMemory,
                 "not enough memory to write a picture of " + size,
                 {"ask for a smaller ", SettingHint{"size"}}};
  }
  return Error{ErrorCode::kBadInput,
               "the picture of " + size + " cannot be written as PNG: " + writer.failure};
}

}  // namespace geotherm::app
