// SPDX-License-Identifier: MIT
#include "ui/places.h"

#include <algorithm>
#include <cmath>

namespace geotherm::ui {
namespace {

/// Widths of both side bars that fit beside the picture.
struct Bars {
  float left = 0, right = 0;
};
Bars fit_bars(Bars wanted, float room, float least) {
  if (room < least + least) wanted.right = wanted.left > 0 ? 0 : wanted.right;
  if (room < least) return {};
  const float total = wanted.left + wanted.right;
  if (total <= room) return wanted;
  // Both give what they have above the least, in proportion to it.
  const auto above = [least](float width) { return std::max(0.0F, width - least); };
  const float spare = above(wanted.left) + above(wanted.right);
  if (spare <= 0) return {std::min(wanted.left, room), 0};
  const float share = std::min(1.0F, (total - room) / spare);
  return {wanted.left - share * above(wanted.left), wanted.right - share * above(wanted.right)};
}

}  // namespace

Places place_panels(const Layout& layout, float width, float height, float scale, float line) {
  width = std::max(0.0F, width);
  height = std::max(0.0F, height);
  const float least_canvas = kMinCanvas * scale;
  Places places;
  const float menu = std::min(line, height);
  const float status = height - menu - line >= least_canvas * 0.5F ? line : 0;
  const float middle = height - menu - status;

  Bars bars{layout.left ? std::max(layout.left_width, kMinBar) * scale : 0,
            layout.right ? std::max(layout.right_width, kMinBar) * scale : 0};
  bars = fit_bars(bars, width - least_canvas, kMinBar * scale);
  bars = {std::floor(bars.left), std::floor(bars.right)};

  float log = layout.log ? std::max(layout.log_height, kMinLog) * scale : 0;
  log = std::floor(std::min(log, middle - least_canvas));
  if (log < kMinLog * scale) log = 0;

  const float inner = width - bars.left - bars.right;
  places.menu = {0, 0, width, menu};
  places.left = {0, menu, bars.left, middle};
  places.right = {width - bars.right, menu, bars.right, middle};
  places.canvas = {bars.left, menu, inner, middle - log};
  places.log = {bars.left, menu + middle - log, log > 0 ? inner : 0, log};
  places.status = {0, height - status, status > 0 ? width : 0, status};
  return places;
}

}  // namespace geotherm::ui
