// SPDX-License-Identifier: MIT
#include "engine/overlay/overlay.h"

#include <algorithm>
#include <cstddef>

namespace geotherm::engine {

char32_t take_letter(std::string_view& text) {
  const auto byte = [&](std::size_t i) -> char32_t { return static_cast<unsigned char>(text[i]); };
  const char32_t lead = byte(0);
  const std::size_t length = lead < 0x80           ? 1
                             : (lead >> 5) == 0x6  ? 2
                             : (lead >> 4) == 0xE  ? 3
                             : (lead >> 3) == 0x1E ? 4
                                                   : 0;
  char32_t letter = length <= 1 ? lead : lead & (0x7FU >> length);
  std::size_t used = 1;
  for (; used < length && used < text.size() && (byte(used) >> 6) == 0x2; ++used) {
    letter = (letter << 6) | (byte(used) & 0x3F);
  }
  text.remove_prefix(used);
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = letter >= 0xD800 && letter < 0xE000;
  const bool good = used == length && letter >= kSmallest[length] && letter <= 0x10FFFF;
  return good && !surrogate ? letter : kMalformed;
}

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  text.remove_prefix(begin);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

std::string cut_to_width(const GlyphAtlas& atlas, std::string_view text, float width) {
  text = trimmed(text);
  const float room = width - atlas.width_of(kEllipsis);
  float used = 0;
  std::size_t kept = 0;  // bytes of the letters that leave room for the ellipsis
  for (std::string_view rest = text; !rest.empty();) {
    used += atlas.glyph(take_letter(rest)).advance;
    if (used <= room) kept = text.size() - rest.size();
  }
  if (used <= width) return std::string(text);
  if (room < 0) return {};
  return std::string(trimmed(text.substr(0, kept))) + std::string(kEllipsis);
}

std::vector<std::string> wrapped_lines(const GlyphAtlas& atlas, std::string_view text, float width,
                                       std::size_t most) {
  std::vector<std::string> lines;
  std::string_view rest = trimmed(text);
  while (!rest.empty() && lines.size() < most) {
    std::size_t end = rest.size();
    while (lines.size() + 1 < most && atlas.width_of(rest.substr(0, end)) > width) {
      const std::size_t blank = trimmed(rest.substr(0, end)).find_last_of(' ');
      if (blank == std::string_view::npos) break;
      end = blank;
    }
    lines.push_back(cut_to_width(atlas, rest.substr(0, end), width));
    rest = trimmed(rest.substr(end));
  }
  return lines;
}

namespace {

struct Corner {
  glm::vec2 position, uv;
};

/// Two triangles between the corners at the top left and the bottom right.
void add_quad(std::vector<Overlay::Vertex>& vertices, const Corner& min, const Corner& max,
              const glm::vec4& top, const glm::vec4& bottom) {
  const Overlay::Vertex top_left{min.position, min.uv, top};
  const Overlay::Vertex top_right{{max.position.x, min.position.y}, {max.uv.x, min.uv.y}, top};
  const Overlay::Vertex bottom_left{{min.position.x, max.position.y}, {min.uv.x, max.uv.y}, bottom};
  const Overlay::Vertex bottom_right{max.position, max.uv, bottom};
  vertices.insert(vertices.end(),
                  {top_left, bottom_left, top_right, top_right, bottom_left, bottom_right});
}

}  // namespace

void Overlay::add_rectangle(glm::vec2 min, glm::vec2 max, const glm::vec4& colour) {
  add_gradient(min, max, colour, colour);
}

void Overlay::add_gradient(glm::vec2 min, glm::vec2 max, const glm::vec4& top,
                           const glm::vec4& bottom) {
  const glm::vec2 white = atlas.white_uv();
  add_quad(vertices, {min, white}, {max, white}, top, bottom);
  boxes.push_back({min, max, top, bottom});
}

void Overlay::add_text(glm::vec2 base, std::string_view text, const glm::vec4& colour) {
  glm::vec2 pen = glm::floor(base + 0.5F);
  texts.push_back({pen, atlas.width_of(text), std::string(text), colour});
  while (!text.empty()) {
    const GlyphAtlas::Glyph& glyph = atlas.glyph(take_letter(text));
    if (glyph.size.x > 0) {
      const glm::vec2 min = pen + glyph.offset;
      add_quad(vertices, {min, glyph.uv_min}, {min + glyph.size, glyph.uv_max}, colour, colour);
    }
    pen.x += glyph.advance;
  }
}

}  // namespace geotherm::engine
