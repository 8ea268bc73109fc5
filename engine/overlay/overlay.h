// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::engine {

/// The font that everything is written in (DejaVu Sans, embedded): a TrueType file.
std::span<const std::byte> font_file();

/// Letters as one 8-bit coverage image; made for the texts that will be drawn, of any script that
/// the font (DejaVu Sans, embedded) covers.
class GlyphAtlas {
 public:
  GlyphAtlas() = default;
  /// `height`: of a line of text in pixels, 4 to 400; adapted a little so that letters are sharp.
  /// Texts are UTF-8; what is not, and letters that the font lacks, show as a box.
  static GlyphAtlas build(float height, const std::vector<std::string>& texts);

  struct Glyph {
    glm::vec2 uv_min, uv_max;  ///< in the image, 0 to 1
    glm::vec2 offset, size;    ///< of its quad from the pen on the base line, pixels
    float advance = 0;
  };
  const Glyph& glyph(char32_t letter) const;
  float line_height() const { return line_height_; }
  float ascent() const { return ascent_; }          ///< base line below the top of a line
  glm::vec2 white_uv() const { return white_uv_; }  ///< a texel of full coverage
  float width_of(std::string_view text) const;

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint8_t>& pixels() const { return pixels_; }  ///< width x height, rows

 private:
  std::vector<std::pair<char32_t, Glyph>> glyphs_;  // sorted by letter
  std::vector<std::uint8_t> pixels_ = {255};
  int width_ = 1, height_ = 1;
  float line_height_ = 1, ascent_ = 1;
  glm::vec2 white_uv_{0.5F, 0.5F};
};

/// Flat shapes and text over the picture.
struct Overlay {
  struct Vertex {
    glm::vec2 position;  ///< pixels from the picture's top left corner
    glm::vec2 uv;        ///< in the atlas
    glm::vec4 colour;    ///< sRGB, alpha not multiplied in
  };
  std::vector<Vertex> vertices;  ///< three a triangle
  GlyphAtlas atlas;

  void add_rectangle(glm::vec2 min, glm::vec2 max, const glm::vec4& colour);
  /// A rectangle whose colour runs from `top` to `bottom`.
  void add_gradient(glm::vec2 min, glm::vec2 max, const glm::vec4& top, const glm::vec4& bottom);
  /// `base`: left end of the base line. Text is placed on whole pixels.
  void add_text(glm::vec2 base, std::string_view text, const glm::vec4& colour);
};

}  // namespace geotherm::engine
