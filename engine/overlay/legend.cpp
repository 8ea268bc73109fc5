// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "engine/overlay/colour_bar.h"
#include "engine/overlay/overlay.h"

namespace geotherm::engine {
namespace {

/// Below this smaller side a bar would leave nothing to the model.
constexpr float kSmallestForBar = 160;
constexpr float kSmallestForCaption = 90;
/// How wide the colour of a key is and where its words begin, in heights of a line.
constexpr float kSwatch = 1.6F, kKeyOffset = 1.3F * kSwatch;

Measures measures_of(const Legend& legend, glm::vec2 extent) {
  const float line = usual_line(extent);
  const float scale = legend.scale;
  const float scaled = std::isfinite(scale) && scale > 0 ? line * scale : line;
  const float used = legend.line_height > 0 ? legend.line_height : scaled;
  Measures m{};
  m.line = std::round(std::clamp(used, 6.0F, 400.0F));
  m.margin = std::round(0.8F * m.line);
  m.stroke = std::max(1.0F, std::round(m.line / 18));
  return m;
}

GlyphAtlas atlas_of(const Legend& legend, float line) {
  std::vector<std::string> texts = {legend.heading, legend.title, legend.caption,
                                    std::string(kEllipsis), "0"};
  for (const Tick& tick : legend.ticks) texts.push_back(tick.label);
  for (const Key& key : legend.keys) texts.push_back(key.label);
  return GlyphAtlas::build(line, texts);
}

/// What stands for a key's colours: from `left`, about the line `middle`.
void draw_swatch(const Key& key, glm::vec2 left, float width, const Measures& m, Overlay& overlay) {
  const auto stroke = [&](float half, const glm::vec3& colour) {
    overlay.add_rectangle({left.x, left.y - half}, {left.x + width, left.y + half},
                          glm::vec4(colour, 1));
  };
  if (key.patches.empty()) {
    if (key.rim) stroke(3 * m.stroke, *key.rim);
    stroke(key.rim ? 2 * m.stroke : m.stroke, key.colour);
    return;
  }
  const float half = std::round(0.25F * m.line);
  const float each = width / static_cast<float>(key.patches.size());
  for (std::size_t i = 0; i < key.patches.size(); ++i) {
    const float from = std::round(left.x + static_cast<float>(i) * each);
    const float to = std::round(left.x + static_cast<float>(i + 1) * each);
    overlay.add_rectangle({from, left.y - half}, {to, left.y + half}, glm::vec4(key.patches[i], 1));
  }
}

/// In the middle of the upper edge, in two lines at most. Height of what was drawn.
float draw_heading(const Legend& legend, const Measures& m, glm::vec2 extent, Overlay& overlay) {
  const auto lines = wrapped_lines(overlay.atlas, legend.heading, extent.x - 2 * m.margin, 2);
  const float height = overlay.atlas.line_height() * static_cast<float>(lines.size());
  if (lines.empty() || height > 0.25F * extent.y) return 0;
  float widest = 0;
  for (const std::string& line : lines) widest = std::max(widest, overlay.atlas.width_of(line));
  const float left = std::floor((extent.x - widest) / 2);
  draw_paper(legend, {left, m.margin}, {left + widest, m.margin + height}, m.margin, overlay);
  float base = m.margin + overlay.atlas.ascent();
  for (const std::string& line : lines) {
    overlay.add_text({(extent.x - overlay.atlas.width_of(line)) / 2, base}, line,
                     glm::vec4(legend.ink, 1));
    base += overlay.atlas.line_height();
  }
  return height + std::round(0.4F * m.line);
}

glm::vec2 size_of_keys(const Legend& legend, const Measures& m, const GlyphAtlas& atlas) {
  float width = 0;
  for (const Key& key : legend.keys) width = std::max(width, atlas.width_of(key.label));
  return {width + kKeyOffset * m.line,
          atlas.line_height() * static_cast<float>(legend.keys.size())};
}

/// Draws the keys in the upper left corner, from `top` on.
void draw_keys(const Legend& legend, const Measures& m, glm::vec2 size, float top,
               Overlay& overlay) {
  draw_paper(legend, {m.margin, top}, {m.margin + size.x, top + size.y}, m.margin, overlay);
  for (const Key& key : legend.keys) {
    const float middle = std::round(top + 0.55F * overlay.atlas.line_height());
    draw_swatch(key, {m.margin, middle}, kSwatch * m.line, m, overlay);
    overlay.add_text({m.margin + kKeyOffset * m.line, top + overlay.atlas.ascent()}, key.label,
                     glm::vec4(legend.ink, 1));
    top += overlay.atlas.line_height();
  }
}

bool wants_bar(const Legend& legend) { return legend.bar && legend.colours.size() >= 2; }

/// The bar, and the keys beside it or, where that has no room, above it. Returns the height of the
/// keys, 0 where they have no room.
float draw_bar_and_keys(const Legend& legend, const Measures& m, glm::vec2 extent, float top,
                        float bottom, LegendLayout& layout, BarPlace& bar) {
  Overlay& overlay = layout.overlay;
  const bool wanted = wants_bar(legend);
  const bool has_bar = wanted && std::min(extent.x, extent.y) >= kSmallestForBar;
  const glm::vec2 keys = size_of_keys(legend, m, overlay.atlas);
  const float below = keys.y + std::round(0.4F * m.line);
  const bool has_keys =
      !legend.keys.empty() && keys.x <= extent.x - 2 * m.margin && keys.y <= 0.25F * extent.y;
  const std::size_t vertices = overlay.vertices.size(), boxes = overlay.boxes.size(),
                    texts = overlay.texts.size();
  const auto draw_from = [&](float from) {
    overlay.vertices.resize(vertices);
    overlay.boxes.resize(boxes);
    overlay.texts.resize(texts);
    if (has_bar) bar = draw_colour_bar(legend, m, extent, from, bottom, overlay);
    return bar.max.x > 0;
  };
  bool drawn = draw_from(top);
  const bool beside = keys.x <= extent.x - m.margin - std::max(bar.insets.right, m.margin);
  // A row lies below whatever stands here.
  bool room = has_keys && beside;
  if (has_keys && !beside) {
    room = draw_from(top + below);
    drawn = room || draw_from(top);
  }
  if (room) draw_keys(legend, m, keys, top, overlay);
  if (wanted && !drawn) layout.left_out.emplace_back(kBarPart);
  if (!legend.keys.empty() && !room) layout.left_out.emplace_back(kKeysPart);
  return room ? below : 0;
}

}  // namespace

float usual_line(glm::vec2 extent) {
  // 19 pixels of 720; letters below 13 are hard to read.
  return std::max(13.0F, std::min(extent.x, extent.y) / 38);
}

LegendLayout lay_out(const Legend& legend, glm::vec2 extent) {
  LegendLayout layout;
  const float side = std::min(extent.x, extent.y);
  if (!std::isfinite(extent.x + extent.y) || side < kSmallestForCaption) {
    const auto leave_out = [&](bool wanted, const char* part) {
      if (wanted) layout.left_out.emplace_back(part);
    };
    leave_out(!legend.caption.empty(), kCaptionPart);
    leave_out(!legend.heading.empty(), kTitlePart);
    leave_out(wants_bar(legend), kBarPart);
    leave_out(!legend.keys.empty(), kKeysPart);
    return layout;
  }
  const Measures m = measures_of(legend, extent);
  Overlay& overlay = layout.overlay;
  overlay.atlas = atlas_of(legend, m.line);
  layout.line = m.line;

  float bottom = extent.y - m.margin;
  const std::string caption = cut_to_width(overlay.atlas, legend.caption, extent.x - 2 * m.margin);
  if (!caption.empty() && 5 * m.line <= extent.y) {
    const float top = std::floor(extent.y - 0.7F * m.margin - overlay.atlas.line_height());
    draw_paper(legend, {m.margin, top},
               {m.margin + overlay.atlas.width_of(caption), top + overlay.atlas.line_height()},
               m.margin, overlay);
    overlay.add_text({m.margin, top + overlay.atlas.ascent()}, caption, glm::vec4(legend.ink, 1));
    bottom = top - std::round(0.4F * m.line);
    layout.insets.bottom = extent.y - bottom;
  } else if (!legend.caption.empty()) {
    layout.left_out.emplace_back(kCaptionPart);
  }
  const float top = m.margin + draw_heading(legend, m, extent, overlay);
  if (!legend.heading.empty() && top == m.margin) layout.left_out.emplace_back(kTitlePart);
  BarPlace bar;
  const float keys = draw_bar_and_keys(legend, m, extent, top, bottom, layout, bar);
  if (keys > 0 || top > m.margin) layout.insets.top = top + keys;
  layout.insets.right = bar.insets.right;
  layout.insets.bottom = std::max(layout.insets.bottom, bar.insets.bottom);
  layout.bar_min = bar.min;
  layout.bar_max = bar.max;
  return layout;
}

}  // namespace geotherm::engine
