// SPDX-License-Identifier: MIT
#include "engine/overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace geotherm::engine {
namespace {

/// Below this smaller side a bar would leave nothing to the model.
constexpr float kSmallestForBar = 160;
constexpr float kSmallestForCaption = 90;

/// Sizes that follow from the picture's, in whole pixels.
struct Measures {
  float line;    ///< height of a line of text that is asked for
  float margin;  ///< to the picture's sides
  float stroke;  ///< thickness of frames and ticks
};

Measures measures_of(float scale, glm::vec2 extent) {
  // A line is 1/38 of the smaller side: 19 pixels of 720. Letters below 13 are hard to read.
  const float line = std::max(13.0F, std::min(extent.x, extent.y) / 38);
  const float used = std::isfinite(scale) && scale > 0 ? line * scale : line;
  Measures m{};
  m.line = std::round(std::clamp(used, 6.0F, 400.0F));
  m.margin = std::round(0.8F * m.line);
  m.stroke = std::max(1.0F, std::round(m.line / 18));
  return m;
}

GlyphAtlas atlas_of(const Legend& legend, float line) {
  std::vector<std::string> texts = {legend.title, legend.caption, std::string(kEllipsis), "0"};
  for (const Tick& tick : legend.ticks) texts.push_back(tick.label);
  for (const Key& key : legend.keys) texts.push_back(key.label);
  return GlyphAtlas::build(line, texts);
}

/// Ticks on the bar from its lower end up, such that the labels keep `gap` (a share of the bar).
std::vector<const Tick*> ticks_with_room(const std::vector<Tick>& ticks, float gap) {
  std::vector<const Tick*> sorted;
  for (const Tick& tick : ticks) {
    if (tick.position >= 0 && tick.position <= 1) sorted.push_back(&tick);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Tick* a, const Tick* b) { return a->position < b->position; });
  std::vector<const Tick*> kept;
  for (const Tick* tick : sorted) {
    if (kept.empty() || tick->position - kept.back()->position >= gap) kept.push_back(tick);
  }
  return kept;
}

/// Where the parts of the bar's column lie, pixels.
struct Column {
  std::vector<std::string> title;
  std::vector<const Tick*> ticks;
  float left = 0, width = 0, title_top = 0;
  float bar_top = 0, bar_bottom = 0, bar_width = 0;
  float tick_length = 0, label_left = 0;
  bool fits = false;
};

/// `bottom`: the lowest line that the column may touch.
Column lay_out_column(const Legend& legend, const GlyphAtlas& atlas, const Measures& m,
                      glm::vec2 extent, float bottom) {
  Column column;
  column.bar_width = m.line;
  column.tick_length = std::round(0.3F * m.line);
  const float label_offset = column.bar_width + column.tick_length + std::round(0.25F * m.line);
  float labels = 0;
  for (const Tick& tick : legend.ticks) labels = std::max(labels, atlas.width_of(tick.label));
  column.width = label_offset + labels;

  const float title_width = std::max(column.width, std::min(7.5F * m.line, 0.3F * extent.x));
  column.title = wrapped_lines(atlas, legend.title, title_width, 3);
  for (const std::string& line : column.title) {
    column.width = std::max(column.width, atlas.width_of(line));
  }
  column.left = extent.x - m.margin - column.width;
  column.label_left = column.left + label_offset;

  // The column is centred in what is free; labels at the bar's ends reach half a line farther.
  const float half_line = std::ceil(atlas.line_height() / 2);
  const float title_height = column.title.empty()
                                 ? half_line
                                 : atlas.line_height() * static_cast<float>(column.title.size()) +
                                       std::round(0.6F * m.line);
  const float free = bottom - m.margin;
  const float bar = std::floor(std::min(18 * m.line, free - title_height - half_line));
  column.title_top = m.margin + std::floor((free - title_height - bar - half_line) / 2);
  column.bar_top = column.title_top + title_height;
  column.bar_bottom = column.bar_top + bar;
  column.fits = bar >= 4 * m.line && column.width <= 0.45F * extent.x;
  column.ticks = ticks_with_room(legend.ticks, 0.9F * atlas.line_height() / std::max(bar, 1.0F));
  return column;
}

/// Middle of a stroke at this position of the bar, on whole pixels and within the bar.
float stroke_top(const Column& column, float position, float stroke) {
  const float height = column.bar_bottom - column.bar_top;
  const float y = column.bar_bottom - position * height - stroke / 2;
  return std::clamp(std::round(y), column.bar_top, column.bar_bottom - stroke);
}

void draw_isolines(const Legend& legend, const Column& column, float stroke, Overlay& overlay) {
  std::vector<float> tops;
  for (const float position : legend.lines) {
    if (position >= 0 && position <= 1) tops.push_back(stroke_top(column, position, stroke));
  }
  std::sort(tops.begin(), tops.end());
  // Lines that leave no colour between them say nothing.
  for (std::size_t i = 1; i < tops.size(); ++i) {
    if (tops[i] - tops[i - 1] < 3 * stroke) return;
  }
  for (const float top : tops) {
    overlay.add_rectangle({column.left, top}, {column.left + column.bar_width, top + stroke},
                          glm::vec4(legend.ink, 0.55F));
  }
}

void draw_bar(const Legend& legend, const Column& column, float stroke, Overlay& overlay) {
  const float right = column.left + column.bar_width;
  const auto pieces = static_cast<float>(legend.colours.size() - 1);
  const float height = column.bar_bottom - column.bar_top;
  const auto edge = [&](std::size_t i) {
    return column.bar_bottom - height * static_cast<float>(i) / pieces;
  };
  for (std::size_t i = 0; i + 1 < legend.colours.size(); ++i) {
    overlay.add_gradient({column.left, edge(i + 1)}, {right, edge(i)},
                         glm::vec4(legend.colours[i + 1], 1), glm::vec4(legend.colours[i], 1));
  }
  draw_isolines(legend, column, stroke, overlay);

  const glm::vec4 ink(legend.ink, 1);
  const glm::vec2 min(column.left, column.bar_top);
  const glm::vec2 max(right, column.bar_bottom);
  overlay.add_rectangle(min, {max.x, min.y + stroke}, ink);
  overlay.add_rectangle({min.x, max.y - stroke}, max, ink);
  overlay.add_rectangle({min.x, min.y + stroke}, {min.x + stroke, max.y - stroke}, ink);
  overlay.add_rectangle({max.x - stroke, min.y + stroke}, {max.x, max.y - stroke}, ink);
}

/// Something to write on, a little larger than what will be written.
void draw_paper(const Legend& legend, glm::vec2 min, glm::vec2 max, float margin,
                Overlay& overlay) {
  if (legend.paper.a <= 0) return;
  const float room = std::floor(0.4F * margin);
  overlay.add_rectangle(min - room, max + room, legend.paper);
}

void draw_column(const Legend& legend, const Column& column, float stroke, Overlay& overlay) {
  const glm::vec4 ink(legend.ink, 1);
  float base = column.title_top + overlay.atlas.ascent();
  for (const std::string& line : column.title) {
    overlay.add_text({column.left, base}, line, ink);
    base += overlay.atlas.line_height();
  }
  draw_bar(legend, column, stroke, overlay);
  const float right = column.left + column.bar_width;
  const float digit_height = -overlay.atlas.glyph(U'0').offset.y;
  for (const Tick* tick : column.ticks) {
    const float top = stroke_top(column, tick->position, stroke);
    overlay.add_rectangle({right, top}, {right + column.tick_length, top + stroke}, ink);
    overlay.add_text({column.label_left, top + std::ceil((digit_height + stroke) / 2)}, tick->label,
                     ink);
  }
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

/// Height of what was drawn, 0 where there is no room.
float draw_keys(const Legend& legend, const Measures& m, glm::vec2 extent, Overlay& overlay) {
  const float swatch = 1.6F * m.line;
  float width = 0;
  for (const Key& key : legend.keys) width = std::max(width, overlay.atlas.width_of(key.label));
  width += 1.3F * swatch;
  const float height = overlay.atlas.line_height() * static_cast<float>(legend.keys.size());
  if (legend.keys.empty() || width > extent.x - 2 * m.margin || height > 0.25F * extent.y) return 0;
  draw_paper(legend, {m.margin, m.margin}, {m.margin + width, m.margin + height}, m.margin,
             overlay);
  float top = m.margin;
  for (const Key& key : legend.keys) {
    const float middle = std::round(top + 0.55F * overlay.atlas.line_height());
    draw_swatch(key, {m.margin, middle}, swatch, m, overlay);
    overlay.add_text({m.margin + 1.3F * swatch, top + overlay.atlas.ascent()}, key.label,
                     glm::vec4(legend.ink, 1));
    top += overlay.atlas.line_height();
  }
  return height;
}

}  // namespace

LegendLayout lay_out(const Legend& legend, glm::vec2 extent) {
  LegendLayout layout;
  const float side = std::min(extent.x, extent.y);
  if (!std::isfinite(extent.x + extent.y) || side < kSmallestForCaption) return layout;
  const Measures m = measures_of(legend.scale, extent);
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
  }
  const float keys = draw_keys(legend, m, extent, overlay);
  if (keys > 0) layout.insets.top = m.margin + keys;
  if (legend.bar && legend.colours.size() >= 2 && side >= kSmallestForBar) {
    const Column column = lay_out_column(legend, overlay.atlas, m, extent, bottom);
    if (column.fits) {
      draw_paper(legend, {column.left, column.title_top},
                 {column.left + column.width, column.bar_bottom + overlay.atlas.line_height() / 2},
                 m.margin, overlay);
      draw_column(legend, column, m.stroke, overlay);
      layout.insets.right = extent.x - column.left + m.margin;
      layout.bar_min = {column.left, column.bar_top};
      layout.bar_max = {column.left + column.bar_width, column.bar_bottom};
    }
  }
  return layout;
}

}  // namespace geotherm::engine
