// SPDX-License-Identifier: MIT
#include "app/picture/picture_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/picture/face_view.h"

namespace geotherm::app {
namespace {

/// Labels keep their distance on a bar of any length with so many.
constexpr int kMaxTicks = 7;
/// Isolines that are not what the picture is about are farther apart by this.
constexpr double kFewer = 2.5;

/// Views of faces have scales of their own, not those of distances.
PictureScale face_scale(const PictureData& data, const PictureSettings& settings) {
  PictureScale scale;
  scale.colour_map = colour_map_of(data, settings);
  scale.max = data.face_values.empty() ? 1 : double{data.largest_face_value};
  scale.bar = settings.bar && !data.face_values.empty();
  if (scale.bar) {
    scale.ticks =
        make_ticks(scale.min, scale.max, kMaxTicks, face_tick_step(settings.view).value_or(0));
  }
  return scale;
}

}  // namespace

std::string colour_map_of(const PictureData& data, const PictureSettings& settings) {
  // From near red to far blue is for distances: there is nothing wrong with a red face.
  if (face_field(settings.view)) {
    return settings.colour_map == PictureSettings().colour_map ? "viridis" : settings.colour_map;
  }
  constexpr std::array kDiverging = {"cool-warm", "red-yellow-blue"};
  const bool fits = std::ranges::find(kDiverging, settings.colour_map) != kDiverging.end();
  return data.is_signed && !fits ? kDiverging[0] : settings.colour_map;
}

bool needs_sources(View view) {
  if (face_field(view)) return needs_distances(view);
  return view != View::kWireframe && view != View::kFlat && view != View::kSmooth;
}

bool maps_values(View view) { return view == View::kContours || view == View::kExactError; }

bool shows_regions(const PictureData& data, const PictureSettings& settings) {
  return settings.view == View::kRegions && !data.nearest.empty();
}

PictureScale picture_scale(const PictureData& data, const PictureSettings& settings) {
  if (face_field(settings.view)) return face_scale(data, settings);
  const double largest = data.largest_value * data.value_unit;
  // A range is one of distances: an error keeps its 0 in the middle of the map.
  const bool is_error = settings.view == View::kExactError;
  const std::optional<double> none;
  const std::optional<double>& range_min = is_error ? none : settings.range_min;
  const std::optional<double>& range_max = is_error ? none : settings.range_max;
  const bool has_range = range_min || range_max;
  PictureScale scale;
  scale.colour_map = colour_map_of(data, settings);
  const double smallest = data.is_signed ? -(largest > 0 ? largest : 1) : 0;
  scale.min = range_min.value_or(smallest);
  scale.max = range_max.value_or(largest > 0 ? largest : 1);
  if (!(scale.max > scale.min)) {  // one end was given, and lies beyond all distances
    const double width = std::max({data.value_unit, std::abs(scale.min), std::abs(scale.max)});
    if (range_max) {
      scale.min = scale.max - width;
    } else {
      scale.max = scale.min + width;
    }
  }
  const bool painted = maps_values(settings.view) && !data.values.empty();
  const bool shown = painted || (settings.view == View::kRegions && !data.values.empty());
  // Where all distances are 0 an isoline would be all of the surface.
  if (shown && largest > 0) {
    scale.coloured = true;
    const double width = scale.max - scale.min;
    const double usual = data.is_signed ? 0 : round_spacing(painted ? width : kFewer * width);
    scale.spacing = settings.line_spacing.value_or(usual);
    // More lines than pixels are no lines.
    const double pixels = std::max(settings.width, settings.height);
    if (width > pixels * scale.spacing) scale.spacing = 0;
  }
  scale.bar = settings.bar && painted && (largest > 0 || has_range);
  if (scale.bar) scale.ticks = make_ticks(scale.min, scale.max, kMaxTicks, scale.spacing);
  return scale;
}

}  // namespace geotherm::app
