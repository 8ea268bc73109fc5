// SPDX-License-Identifier: MIT
#include "engine/overlay/overlay.h"

#include <cmath>

#include "engine/overlay/utf8.h"

namespace geotherm::engine {
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
}

void Overlay::add_text(glm::vec2 base, std::string_view text, const glm::vec4& colour) {
  glm::vec2 pen = glm::floor(base + 0.5F);
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
