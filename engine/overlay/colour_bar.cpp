// SPDX-License-Identifier: MIT
#include "engine/overlay/colour_bar.h"

#include <algorithm>
#include <cmath>

namespace geotherm::engine {
namespace {

/// A rectangle whose colours run upwards, or to the right.
struct Bar {
  glm::vec2 min, max;  ///< without the arrows
  bool upright = true;

  float length() const { return upright ? max.y - min.y : max.x - min.x; }

  /// The first pixel of a stroke across the bar at this position, on whole pixels and within it.
  float stroke_at(float position, float stroke) const {
    const float low = upright ? min.y : min.x, high = upright ? max.y : max.x;
    const float middle = upright ? high - position * length() : low + position * length();
    return std::clamp(std::round(middle - stroke / 2), low, high - stroke);
  }

  void add_stroke(float at, float stroke, const glm::vec4& colour, Overlay& overlay) const {
    if (upright) {
      overlay.add_rectangle({min.x, at}, {max.x, at + stroke}, colour);
    } else {
      overlay.add_rectangle({at, min.y}, {at + stroke, max.y}, colour);
    }
  }
};

void draw_isolines(const Legend& legend, const Bar& bar, float stroke, Overlay& overlay) {
  std::vector<float> places;
  for (const float position : legend.lines) {
    if (position >= 0 && position <= 1) places.push_back(bar.stroke_at(position, stroke));
  }
  std::sort(places.begin(), places.end());
  // Lines that leave no colour between them say nothing.
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i] - places[i - 1] < 3 * stroke) return;
  }
  for (const float at : places) bar.add_stroke(at, stroke, glm::vec4(legend.ink, 0.55F), overlay);
}

/// A triangle with smooth sides: row after row from its base at the bar's end to its tip, the
/// outermost pixels as dense as they are covered.
void draw_triangle(const Bar& bar, bool beyond_high, float base, float tip, const glm::vec4& colour,
                   Overlay& overlay) {
  const float middle = bar.upright ? (bar.min.x + bar.max.x) / 2 : (bar.min.y + bar.max.y) / 2;
  const auto cell = [&](float along, float from, float to, float cover) {
    const float end = beyond_high != bar.upright ? (bar.upright ? bar.max.y : bar.max.x)
                                                 : (bar.upright ? bar.min.y : bar.min.x);
    const float at = beyond_high != bar.upright ? end + along : end - along - 1;
    const glm::vec4 shade(glm::vec3(colour), colour.a * cover);
    if (bar.upright) {
      overlay.add_rectangle({from, at}, {to, at + 1}, shade);
    } else {
      overlay.add_rectangle({at, from}, {at + 1, to}, shade);
    }
  };
  for (float along = 0; along < tip; ++along) {
    const float half = base * (1 - (along + 0.5F) / tip);
    const float low = middle - half, high = middle + half;
    const float first = std::ceil(low), last = std::floor(high);
    if (first > last) {
      cell(along, last, first, high - low);
      continue;
    }
    cell(along, first, last, 1);
    if (first > low) cell(along, first - 1, first, first - low);
    if (high > last) cell(along, last, last + 1, high - last);
  }
}

float arrow_length(float bar_width) { return std::round(0.6F * bar_width); }

/// Draws an arrow at each end beyond which there are values, in the colour of that end.
void draw_arrows(const Legend& legend, const Bar& bar, float stroke, Overlay& overlay) {
  const float width = bar.upright ? bar.max.x - bar.min.x : bar.max.y - bar.min.y;
  const float tip = arrow_length(width);
  for (const bool high : {false, true}) {
    if (!(high ? legend.above : legend.below)) continue;
    const glm::vec3& colour = high ? legend.colours.back() : legend.colours.front();
    draw_triangle(bar, high, width / 2, tip, glm::vec4(legend.ink, 1), overlay);
    draw_triangle(bar, high, width / 2 - 1.5F * stroke, tip - 2 * stroke, glm::vec4(colour, 1),
                  overlay);
  }
}

void draw_bar(const Legend& legend, const Bar& bar, float stroke, Overlay& overlay) {
  const auto pieces = static_cast<float>(legend.colours.size() - 1);
  const auto edge = [&](std::size_t i) {
    const float along = bar.length() * static_cast<float>(i) / pieces;
    return bar.upright ? bar.max.y - along : bar.min.x + along;
  };
  for (std::size_t i = 0; i + 1 < legend.colours.size(); ++i) {
    const glm::vec4 low(legend.colours[i], 1), high(legend.colours[i + 1], 1);
    if (bar.upright) {
      overlay.add_gradient({bar.min.x, edge(i + 1)}, {bar.max.x, edge(i)}, high, low);
    } else {
      overlay.add_rectangle({edge(i), bar.min.y}, {edge(i + 1), bar.max.y}, (low + high) / 2.0F);
    }
  }
  draw_isolines(legend, bar, stroke, overlay);

  const glm::vec4 ink(legend.ink, 1);
  const glm::vec2& min = bar.min;
  const glm::vec2& max = bar.max;
  overlay.add_rectangle(min, {max.x, min.y + stroke}, ink);
  overlay.add_rectangle({min.x, max.y - stroke}, max, ink);
  overlay.add_rectangle({min.x, min.y + stroke}, {min.x + stroke, max.y - stroke}, ink);
  overlay.add_rectangle({max.x - stroke, min.y + stroke}, {max.x, max.y - stroke}, ink);
  draw_arrows(legend, bar, stroke, overlay);
}

/// Ticks on the bar, from its lower end up.
std::vector<const Tick*> ticks_on(const std::vector<Tick>& ticks) {
  std::vector<const Tick*> sorted;
  for (const Tick& tick : ticks) {
    if (tick.position >= 0 && tick.position <= 1) sorted.push_back(&tick);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Tick* a, const Tick* b) { return a->position < b->position; });
  return sorted;
}

/// The ticks whose labels are at least `gap` (a share of the bar) apart.
std::vector<const Tick*> ticks_apart(const std::vector<Tick>& ticks, float gap) {
  std::vector<const Tick*> kept;
  for (const Tick* tick : ticks_on(ticks)) {
    if (kept.empty() || tick->position - kept.back()->position >= gap) kept.push_back(tick);
  }
  return kept;
}

/// All, or each second, third, ... such that no label touches the next. `width_of` one, pixels.
template <class WidthOf>
std::vector<const Tick*> ticks_in_row(const std::vector<Tick>& ticks, float length,
                                      const WidthOf& width_of) {
  const std::vector<const Tick*> all = ticks_on(ticks);
  std::vector<const Tick*> kept;
  for (std::size_t stride = 1; stride <= all.size(); ++stride) {
    kept.clear();
    bool fits = true;
    for (std::size_t i = 0; i < all.size(); i += stride) {
      fits = fits && (kept.empty() || length * (all[i]->position - kept.back()->position) >=
                                          (width_of(*kept.back()) + width_of(*all[i])) / 2);
      kept.push_back(all[i]);
    }
    if (fits) break;
  }
  return kept;
}

/// Words that no-break spaces join are parted where they would be cut.
std::vector<std::string> title_lines(const GlyphAtlas& atlas, std::string title, float width,
                                     std::size_t most) {
  auto lines = wrapped_lines(atlas, title, width, most);
  const auto is_cut = [](const std::string& line) { return line.ends_with(kEllipsis); };
  if (std::none_of(lines.begin(), lines.end(), is_cut)) return lines;
  constexpr std::string_view kJoint = "\u00a0";
  for (auto at = title.find(kJoint); at != std::string::npos; at = title.find(kJoint, at)) {
    title.replace(at, kJoint.size(), " ");
  }
  return wrapped_lines(atlas, title, width, most);
}

void draw_title(const std::vector<std::string>& title, glm::vec2 corner, const glm::vec4& ink,
                Overlay& overlay) {
  float base = corner.y + overlay.atlas.ascent();
  for (const std::string& line : title) {
    overlay.add_text({corner.x, base}, line, ink);
    base += overlay.atlas.line_height();
  }
}

float title_height(const std::vector<std::string>& title, const Measures& m,
                   const GlyphAtlas& atlas) {
  return atlas.line_height() * static_cast<float>(title.size()) + std::round(0.6F * m.line);
}

/// Draws the bar at the right side; draws nothing where it does not fit.
BarPlace draw_column(const Legend& legend, const Measures& m, glm::vec2 extent, float top,
                     float bottom, Overlay& overlay) {
  const GlyphAtlas& atlas = overlay.atlas;
  const float bar_width = m.line;
  const float tick_length = std::round(0.3F * m.line);
  const float label_offset = bar_width + tick_length + std::round(0.25F * m.line);
  float labels = 0;
  for (const Tick& tick : legend.ticks) labels = std::max(labels, atlas.width_of(tick.label));
  float width = label_offset + labels;
  const float title_width = std::max(width, std::min(7.5F * m.line, 0.3F * extent.x));
  const auto title = title_lines(atlas, legend.title, title_width, 3);
  for (const std::string& line : title) width = std::max(width, atlas.width_of(line));
  const float left = extent.x - m.margin - width;

  // The column is centred in what is free; labels at the bar's ends reach half a line farther.
  const float half_line = std::ceil(atlas.line_height() / 2);
  const float arrow = arrow_length(bar_width);
  const float above =
      (title.empty() ? half_line : title_height(title, m, atlas)) + (legend.above ? arrow : 0);
  const float below = legend.below ? std::max(half_line, arrow) : half_line;
  const float free = bottom - top;
  const float height = std::floor(std::min(18 * m.line, free - above - below));
  if (height < 3 * m.line || width > 0.45F * extent.x) return {};
  const float title_top = top + std::floor((free - above - height - below) / 2);
  const Bar bar{{left, title_top + above}, {left + bar_width, title_top + above + height}};

  draw_paper(legend, {left, title_top},
             {left + width, bar.max.y + (legend.below ? below : atlas.line_height() / 2)}, m.margin,
             overlay);
  const glm::vec4 ink(legend.ink, 1);
  draw_title(title, {left, title_top}, ink, overlay);
  draw_bar(legend, bar, m.stroke, overlay);
  const float digit_height = -atlas.glyph(U'0').offset.y;
  for (const Tick* tick : ticks_apart(legend.ticks, 0.9F * atlas.line_height() / height)) {
    const float y = bar.stroke_at(tick->position, m.stroke);
    overlay.add_rectangle({bar.max.x, y}, {bar.max.x + tick_length, y + m.stroke}, ink);
    overlay.add_text({left + label_offset, y + std::ceil((digit_height + m.stroke) / 2)},
                     tick->label, ink);
  }
  return {{.right = extent.x - left + m.margin}, bar.min, bar.max};
}

/// Along the lower edge; nothing where it does not fit.
BarPlace draw_row(const Legend& legend, const Measures& m, glm::vec2 extent, float top,
                  float bottom, Overlay& overlay) {
  const GlyphAtlas& atlas = overlay.atlas;
  const float tick_length = std::round(0.3F * m.line);
  float half_label = 0;
  for (const Tick& tick : legend.ticks) {
    half_label = std::max(half_label, std::ceil(atlas.width_of(tick.label) / 2));
  }
  const float arrow = legend.below || legend.above ? arrow_length(m.line) : 0;
  const float side = m.margin + std::max(half_label, arrow);
  const float length = std::floor(std::min(24 * m.line, extent.x - 2 * side));
  const auto title = title_lines(atlas, legend.title, length, 2);
  const float title_room =
      title.empty() ? 0 : title_height(title, m, atlas) - std::round(0.3F * m.line);
  const float height = title_room + m.line + tick_length + atlas.line_height();
  if (length < 8 * m.line || height > 0.35F * (bottom - top)) return {};

  const float left = std::floor((extent.x - length) / 2);
  const float title_top = std::floor(bottom - height);
  const float bar_top = title_top + title_room;
  const Bar bar{{left, bar_top}, {left + length, bar_top + m.line}, false};
  draw_paper(legend, {left - side + m.margin, title_top}, {left + length + side - m.margin, bottom},
             m.margin, overlay);
  const glm::vec4 ink(legend.ink, 1);
  draw_title(title, {left, title_top}, ink, overlay);
  draw_bar(legend, bar, m.stroke, overlay);
  const auto width_of = [&](const Tick& tick) {
    return atlas.width_of(tick.label) + 0.6F * m.line;
  };
  for (const Tick* tick : ticks_in_row(legend.ticks, length, width_of)) {
    const float x = bar.stroke_at(tick->position, m.stroke);
    overlay.add_rectangle({x, bar.max.y}, {x + m.stroke, bar.max.y + tick_length}, ink);
    overlay.add_text({x + (m.stroke - atlas.width_of(tick->label)) / 2,
                      bar.max.y + tick_length + atlas.ascent()},
                     tick->label, ink);
  }
  return {{.bottom = extent.y - title_top + m.margin}, bar.min, bar.max};
}

}  // namespace

void draw_paper(const Legend& legend, glm::vec2 min, glm::vec2 max, float margin,
                Overlay& overlay) {
  if (legend.paper.a <= 0) return;
  const float room = std::floor(0.4F * margin);
  overlay.add_rectangle(min - room, max + room, legend.paper);
}

BarPlace draw_colour_bar(const Legend& legend, const Measures& m, glm::vec2 extent, float top,
                         float bottom, Overlay& overlay) {
  const bool portrait = !legend.at_side && extent.y > extent.x;
  for (const bool row : {portrait, !portrait}) {
    const BarPlace place = (row ? draw_row : draw_column)(legend, m, extent, top, bottom, overlay);
    if (place.max.x > 0) return place;
  }
  return {};
}

}  // namespace geotherm::engine
