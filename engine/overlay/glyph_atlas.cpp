// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>

#include "embedded/legend_font.h"
#include "engine/overlay/overlay.h"

namespace geotherm::engine {
namespace {

constexpr int kGap = 1;    // between glyphs, so that none bleeds into its neighbour
constexpr int kWhite = 3;  // side of the white patch; its middle stays white when filtered

/// A glyph of the font before it has a place in the atlas.
struct Shape {
  char32_t letter = kMalformed;
  int index = 0;          // in the font; 0: the box
  int left = 0, top = 0;  // from the pen on the base line
  int width = 0, height = 0;
  int x = 0, y = 0;  // in the atlas
};

struct Font {
  stbtt_fontinfo info{};
  float scale = 1;
  float height = 1, ascent = 1;

  explicit Font(float line_height) {
    stbtt_InitFont(&info, embedded::legend_font().data(), 0);
    scale = stbtt_ScaleForPixelHeight(&info, line_height);
    // Low letters of a whole number of pixels have sharp edges above as well as on the base line.
    int left = 0, bottom = 0, right = 0, top = 0;
    stbtt_GetCodepointBox(&info, 'x', &left, &bottom, &right, &top);
    const float low_letter = scale * static_cast<float>(top);
    if (low_letter > 0) scale *= std::max(1.0F, std::round(low_letter)) / low_letter;
    int up = 0, down = 0, gap = 0;
    stbtt_GetFontVMetrics(&info, &up, &down, &gap);
    ascent = std::ceil(scale * static_cast<float>(up));
    height = ascent + std::ceil(-scale * static_cast<float>(down));
  }

  Shape shape(char32_t letter) const {
    Shape shape{.letter = letter};
    if (letter <= 0x10FFFF) shape.index = stbtt_FindGlyphIndex(&info, static_cast<int>(letter));
    int right = 0, bottom = 0;
    stbtt_GetGlyphBitmapBox(&info, shape.index, scale, scale, &shape.left, &shape.top, &right,
                            &bottom);
    shape.width = right - shape.left;
    shape.height = bottom - shape.top;
    return shape;
  }

  /// Whole pixels: each letter then looks the same wherever it stands.
  float advance(const Shape& shape) const {
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&info, shape.index, &advance, &bearing);
    return std::round(scale * static_cast<float>(advance));
  }
};

std::vector<char32_t> letters_of(const std::vector<std::string>& texts) {
  std::vector<char32_t> letters = {kMalformed};
  for (const std::string& text : texts) {
    for (std::string_view rest = text; !rest.empty();) letters.push_back(take_letter(rest));
  }
  std::sort(letters.begin(), letters.end());
  letters.erase(std::unique(letters.begin(), letters.end()), letters.end());
  return letters;
}

/// Gives every shape a place, row by row, the highest first; returns the height that takes.
int place(std::vector<Shape>& shapes, int width) {
  std::vector<Shape*> order;
  order.reserve(shapes.size());
  for (Shape& shape : shapes) order.push_back(&shape);
  std::stable_sort(order.begin(), order.end(),
                   [](const Shape* a, const Shape* b) { return a->height > b->height; });
  int x = kWhite + kGap;
  int y = 0;
  int row = kWhite;
  for (Shape* shape : order) {
    if (x + shape->width > width) {
      y += row + kGap;
      x = row = 0;
    }
    shape->x = x;
    shape->y = y;
    x += shape->width + kGap;
    row = std::max(row, shape->height);
  }
  return y + row;
}

/// A width that makes the atlas about square.
int choose_width(const std::vector<Shape>& shapes) {
  double area = 0;
  int widest = 0;
  for (const Shape& shape : shapes) {
    area += static_cast<double>(shape.width + kGap) * (shape.height + kGap);
    widest = std::max(widest, shape.width);
  }
  const int side = std::max({static_cast<int>(std::sqrt(area)), widest, kWhite});
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(side)));
}

}  // namespace

GlyphAtlas GlyphAtlas::build(float height, const std::vector<std::string>& texts) {
  const Font font(height > 4 ? std::min(height, 400.0F) : 4.0F);
  std::vector<Shape> shapes;
  for (const char32_t letter : letters_of(texts)) {
    const Shape shape = font.shape(letter);
    if (shape.index != 0 || letter == kMalformed) shapes.push_back(shape);  // one box is enough
  }

  GlyphAtlas atlas;
  atlas.width_ = choose_width(shapes);
  atlas.height_ = place(shapes, atlas.width_);
  atlas.line_height_ = font.height;
  atlas.ascent_ = font.ascent;
  const auto pitch = static_cast<std::size_t>(atlas.width_);
  atlas.pixels_.assign(pitch * static_cast<std::size_t>(atlas.height_), 0);
  const auto at = [&](int x, int y) { return atlas.pixels_.data() + pitch * y + x; };

  const glm::vec2 size(atlas.width_, atlas.height_);
  for (int y = 0; y < kWhite; ++y) std::fill_n(at(0, y), kWhite, std::uint8_t{255});
  atlas.white_uv_ = glm::vec2(kWhite / 2.0F) / size;

  for (const Shape& shape : shapes) {
    const glm::vec2 corner(shape.x, shape.y);
    const glm::vec2 extent(shape.width, shape.height);
    atlas.glyphs_.emplace_back(shape.letter, Glyph{corner / size,
                                                   (corner + extent) / size,
                                                   {shape.left, shape.top},
                                                   extent,
                                                   font.advance(shape)});
    if (shape.width <= 0 || shape.height <= 0) continue;
    stbtt_MakeGlyphBitmap(&font.info, at(shape.x, shape.y), shape.width, shape.height, atlas.width_,
                          font.scale, font.scale, shape.index);
  }
  return atlas;
}

const GlyphAtlas::Glyph& GlyphAtlas::glyph(char32_t letter) const {
  static constexpr Glyph kNone{};
  if (glyphs_.empty()) return kNone;
  const auto found =
      std::lower_bound(glyphs_.begin(), glyphs_.end(), letter,
                       [](const auto& entry, char32_t wanted) { return entry.first < wanted; });
  // The last one is the box: kMalformed is greater than any letter.
  return found != glyphs_.end() && found->first == letter ? found->second : glyphs_.back().second;
}

float GlyphAtlas::width_of(std::string_view text) const {
  float width = 0;
  while (!text.empty()) width += glyph(take_letter(text)).advance;
  return width;
}

std::vector<std::string_view> missing_letters(std::string_view text) {
  const Font font(4);
  std::vector<std::string_view> missing;
  while (!text.empty()) {
    std::string_view rest = text;
    const char32_t letter = take_letter(rest);
    const std::string_view piece = text.substr(0, text.size() - rest.size());
    const bool lacks = letter != kMalformed && font.shape(letter).index == 0;
    if (lacks && std::ranges::find(missing, piece) == missing.end()) missing.push_back(piece);
    text = rest;
  }
  return missing;
}

std::span<const std::byte> font_file() { return std::as_bytes(std::span(embedded::legend_font())); }

}  // namespace geotherm::engine
