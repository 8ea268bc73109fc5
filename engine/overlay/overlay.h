// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/colours.h"

namespace geotherm::engine {

/// What stands for bytes that are not UTF-8; no letter.
inline constexpr char32_t kMalformed = 0xFFFFFFFF;

/// Takes the first letter off a text that is not empty. Bytes that are not UTF-8 (cut off,
/// overlong, surrogates, beyond U+10FFFF) are taken as one kMalformed each or, where they begin
/// like a longer letter, together.
char32_t take_letter(std::string_view& text);

/// The font that everything is written in (DejaVu Sans, embedded): a TrueType file.
std::span<const std::byte> font_file();

/// The letters of a text that the font lacks, each once: pieces of it.
std::vector<std::string_view> missing_letters(std::string_view text);

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

  /// What was added, for pictures that keep shapes.
  struct Box {
    glm::vec2 min, max;
    glm::vec4 top, bottom;
  };
  struct Text {
    glm::vec2 base;
    float width = 0;  ///< pixels
    std::string text;
    glm::vec4 colour;
  };
  std::vector<Box> boxes;
  std::vector<Text> texts;

  void add_rectangle(glm::vec2 min, glm::vec2 max, const glm::vec4& colour);
  /// A rectangle whose colour runs from `top` to `bottom`.
  void add_gradient(glm::vec2 min, glm::vec2 max, const glm::vec4& top, const glm::vec4& bottom);
  /// `base`: left end of the base line. Text is placed on whole pixels.
  void add_text(glm::vec2 base, std::string_view text, const glm::vec4& colour);
};

inline constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

/// The text, or as many of its letters as fit into `width` pixels with an ellipsis after them;
/// empty where not even that fits. The atlas must hold kEllipsis.
std::string cut_to_width(const GlyphAtlas& atlas, std::string_view text, float width);

/// The text in lines of at most `width` pixels, broken at blanks. Words that are longer, and the
/// last of `most` lines where text remains, are cut.
std::vector<std::string> wrapped_lines(const GlyphAtlas& atlas, std::string_view text, float width,
                                       std::size_t most);

struct Tick {
  float position = 0;  ///< 0 at the bar's lower end, 1 at its upper end
  std::string label;
};

/// What a colour in the picture stands for.
struct Key {
  glm::vec3 colour{0};
  std::string label;
  std::optional<glm::vec3> rim{};    ///< about the stroke that shows the colour
  std::vector<glm::vec3> patches{};  ///< instead of a stroke: patches of several colours
};

/// What is written around the model; empty parts are left out.
struct Legend {
  bool bar = false;
  bool at_side = false;            ///< the bar, whatever the picture's shape, where that has room
  std::vector<glm::vec3> colours;  ///< of the bar from its lower end up, sRGB, 2 or more
  std::vector<float> lines{};      ///< isolines on the bar: positions as of ticks
  std::vector<Tick> ticks;
  std::string title;                  ///< over the bar: what the values are, and their unit
  bool below = false, above = false;  ///< values lie beyond the bar's ends: arrows there
  std::string heading;                ///< over the picture
  /// One line along the lower edge; cut with an ellipsis where it is too long.
  std::string caption{};
  std::vector<Key> keys{};      ///< one a line in the upper left corner
  glm::vec3 ink{0};             ///< colour of letters and frames
  glm::vec4 paper{1, 1, 1, 0};  ///< under them, so that they can be read where the model lies there
  float scale = 1;              ///< of letters and bar; 1 suits a picture 720 pixels high
  float line_height = 0;        ///< of letters, pixels; 0: as `scale` says
};

/// Parts of a legend, as a sentence names them.
inline constexpr const char* kCaptionPart = "the caption";
inline constexpr const char* kTitlePart = "the title";
inline constexpr const char* kBarPart = "the colour bar";
inline constexpr const char* kKeysPart = "the keys of the colours";

struct LegendLayout {
  Overlay overlay;
  Insets insets;   ///< what the legend takes of the picture's sides; 0 where it has nothing
  float line = 0;  ///< height of a line of text that letters and bar are sized by, pixels
  glm::vec2 bar_min{0}, bar_max{0};     ///< corners of the bar; the same where there is none
  std::vector<std::string> left_out{};  ///< parts of the legend that have no room
};

/// The height of a line of letters, in pixels, that suits a picture of this size.
float usual_line(glm::vec2 extent);

/// Lays the legend out for a picture of this size. Letters grow with the smaller side of the
/// picture. The bar is a column at the right side, or a row along the lower edge of what is higher
/// than wide, or the other one where that has no room; ticks whose labels would touch are thinned
/// out. Keys stand beside the bar or above it. What the picture is too small for is left out. Cost:
/// the glyphs' rasterisation, milliseconds.
LegendLayout lay_out(const Legend& legend, glm::vec2 extent);

}  // namespace geotherm::engine
