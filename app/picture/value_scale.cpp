// SPDX-License-Identifier: MIT
// What the colours of a picture stand for.
#include <algorithm>
#include <cmath>

#include "app/picture/picture_scale.h"
#include "app/picture/picture_text.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

/// Labels keep their distance on a bar of any length with so many.
constexpr int kMaxTicks = 7, kMaxBandTicks = 10;
/// Isolines that are not what the picture is about are farther apart by this.
constexpr double kFewer = 2.5;
/// Ends of a scale that differ by less, as a share of the larger, differ by rounding.
constexpr double kRoundingOfEnds = 1e-12;
/// A logarithmic scale ends at this share of the largest value.
constexpr double kSmallestRatio = 1e-6;

/// The width of bands from 0 to `max` and little more, whose borders are round numbers, and all
/// whole ones where those alone are values.
double face_band_width(View view, double max, int bands) {
  const auto step = face_tick_step(view);
  if (!step) return band_width(max, bands);
  const double in_step = bands * *step / max;
  return in_step >= 1 ? *step / std::floor(in_step) : *step * std::ceil(1 / in_step);
}

/// Views of faces have scales of their own, not those of distances.
PictureScale face_scale(const PictureData& data, const PictureSettings& settings) {
  PictureScale scale;
  scale.colour_map = colour_map_of(data, settings);
  scale.max = data.face_values.empty() ? 1 : double{data.largest_face_value};
  if (settings.bands > 0) {
    scale.max = settings.bands * face_band_width(settings.view, scale.max, settings.bands);
  }
  scale.bar = settings.bar && !data.face_values.empty();
  if (!scale.bar) return scale;
  if (settings.bands > 0) {
    scale.ticks = make_band_ticks(scale.min, scale.max, settings.bands, kMaxBandTicks);
  } else {
    scale.ticks =
        make_ticks(scale.min, scale.max, kMaxTicks, face_tick_step(settings.view).value_or(0));
  }
  format_labels(scale.ticks, settings.number_format);
  scale.above = std::ranges::any_of(data.face_values,
                                    [&](float x) { return x > scale.max * (1 + kSlackOfEnds); });
  return scale;
}

/// The scale that a picture can have: differences have no logarithm, distances no other sign.
ColourScale kind_of(const PictureData& data, const PictureSettings& settings) {
  const ColourScale asked = settings.colour_scale;
  const bool fits =
      asked == ColourScale::kDiverging ? data.is_signed : !data.is_signed && data.largest_value > 0;
  return fits ? asked : ColourScale::kLinear;
}

/// Both ends where neither is given, and round where the scale asks for that.
void set_linear_ends(const PictureData& data, const PictureSettings& settings,
                     PictureScale& scale) {
  const double largest = data.largest_value * data.value_unit;
  const double usual = largest > 0 ? largest : 1;
  if (scale.kind == ColourScale::kDiverging) {  // both ends are as far as the farther one
    const double end = std::max(-settings.range_min.value_or(0), settings.range_max.value_or(0));
    scale.max = end > 0 ? end : round_number_above(usual);
    scale.min = -scale.max;
    return;
  }
  // A range is one of distances: an error keeps its 0 in the middle of the map.
  const bool is_error = settings.view == View::kExactError;
  const std::optional<double> none;
  const std::optional<double>& range_min = is_error ? none : settings.range_min;
  const std::optional<double>& range_max = is_error ? none : settings.range_max;
  const bool between = data.is_field && !data.is_signed;  // the values' own ends
  const double least = data.smallest_value;
  scale.min = range_min.value_or(data.is_signed ? -usual : between ? least : 0);
  scale.max = range_max.value_or(between ? data.greatest_value : usual);
  if (settings.bands > 0 && !range_max && scale.max > scale.min) {
    double each = band_width(scale.max - scale.min, settings.bands);
    if (!range_min && data.is_signed) {
      scale.min = -settings.bands * each / 2;
    } else if (!range_min && between) {
      const double most = scale.max;
      const auto floor_of = [&] { return each * std::floor(least / each); };
      while (floor_of() + settings.bands * each < most) {
        each = band_width(settings.bands * each * (1 + kSlackOfEnds), settings.bands);
      }
      scale.min = floor_of();
    }
    scale.max = scale.min + settings.bands * each;
  }
  if (!(scale.max > scale.min)) {  // one end was given and lies beyond all values, or these are one
    const double width = std::max({data.value_unit, std::abs(scale.min), std::abs(scale.max)});
    if (range_max) {
      scale.min = scale.max - width;
    } else if (range_min || !between) {
      scale.max = scale.min + width;
    } else {
      scale.min -= width / 2;
      scale.max += width / 2;
    }
  }
}

void set_log_ends(const PictureData& data, const PictureSettings& settings, PictureScale& scale) {
  const double largest = data.is_field ? data.greatest_value : data.largest_value * data.value_unit;
  const double smallest = data.smallest_positive;
  const auto is_given = [](const std::optional<double>& end) { return end && *end > 0; };
  // Between numbers that begin with 1, 2 or 5, which are the marks as well.
  scale.max = is_given(settings.range_max) ? *settings.range_max
                                           : log_levels(largest, 10 * largest, 3).front();
  const double least = kSmallestRatio * scale.max;
  scale.min = is_given(settings.range_min)
                  ? *settings.range_min
                  : log_levels(std::max(smallest, least) / 10, std::max(smallest, least), 3).back();
  if (!(scale.min < scale.max)) scale.min = scale.max / 10;
}

/// Where isolines are: at the values that were asked for, between bands, else at multiples of a
/// spacing (of a logarithmic scale: at round numbers).
void set_lines(const PictureData& data, const PictureSettings& settings, bool painted,
               PictureScale& scale) {
  const double width = scale.max - scale.min;
  if (!settings.line_values.empty()) {
    scale.levels = settings.line_values;
    return;
  }
  if (settings.line_spacing) {
    scale.spacing = *settings.line_spacing;
  } else if (settings.bands > 0 && painted) {
    for (int i = 1; i < settings.bands; ++i) {
      scale.levels.push_back(scale.value_at(static_cast<double>(i) / settings.bands));
    }
  } else if (scale.kind == ColourScale::kLog) {
    scale.levels = log_levels(scale.min, scale.max, kMaxLineValues);
  } else if (!data.is_signed || data.is_field) {
    scale.spacing = round_spacing(painted ? width : kFewer * width);
  }
  // More lines than pixels are no lines, nor are those between values that rounding made.
  const double pixels = std::max(settings.width, settings.height);
  const double larger = std::max(std::abs(scale.min), std::abs(scale.max));
  if (width > pixels * scale.spacing || width < kRoundingOfEnds * larger) scale.spacing = 0;
  if (!(data.is_field || data.is_signed) || scale.spacing == 0) return;
  // Multiples below 0 are lines like the others, and so is 0, but of a difference, which may be 0
  // on a whole region: they are named one by one.
  if (width > kMaxLineValues * scale.spacing) {
    if (data.is_field) scale.spacing = 0;  // of a difference those above 0 are drawn
    return;
  }
  const double first = std::floor(scale.min / scale.spacing) + 1;
  for (double i = first; i * scale.spacing < scale.max; ++i) {
    if (i != 0 || data.is_field) scale.levels.push_back(i * scale.spacing);
  }
}

void set_ticks(const PictureSettings& settings, PictureScale& scale) {
  if (scale.kind == ColourScale::kLog && settings.bands > 0) {
    const int each = (settings.bands + kMaxBandTicks - 1) / kMaxBandTicks;
    for (int i = 0; i <= settings.bands; i += each) {
      scale.ticks.values.push_back(scale.value_at(static_cast<double>(i) / settings.bands));
      scale.ticks.labels.push_back(significant(scale.ticks.values.back(), 3));
    }
  } else if (scale.kind == ColourScale::kLog) {
    scale.ticks = make_log_ticks(scale.min, scale.max, kMaxTicks);
  } else if (settings.bands > 0) {
    scale.ticks = make_band_ticks(scale.min, scale.max, settings.bands, kMaxBandTicks);
  } else {
    scale.ticks = make_ticks(scale.min, scale.max, kMaxTicks, scale.spacing);
  }
  format_labels(scale.ticks, settings.number_format);
}

}  // namespace

double PictureScale::place_of(double value) const {
  if (kind != ColourScale::kLog) return (value - min) / (max - min);
  return value > 0 ? std::log(value / min) / std::log(max / min) : 0;
}

double PictureScale::value_at(double place) const {
  if (kind != ColourScale::kLog) return min + place * (max - min);
  return min * std::pow(max / min, place);
}

PictureScale picture_scale(const PictureData& data, const PictureSettings& settings) {
  if (face_field(settings.view)) return face_scale(data, settings);
  if (settings.bands > 0 && !maps_values(settings.view)) {
    PictureSettings without = settings;
    without.bands = 0;
    return picture_scale(data, without);
  }
  const double largest = data.largest_value * data.value_unit;
  const bool has_range = settings.view != View::kExactError &&
                         (settings.range_min.has_value() || settings.range_max.has_value());
  PictureScale scale;
  scale.colour_map = colour_map_of(data, settings);
  scale.kind = kind_of(data, settings);
  if (scale.kind == ColourScale::kLog) {
    set_log_ends(data, settings, scale);
  } else {
    set_linear_ends(data, settings, scale);
  }
  const bool painted = maps_values(settings.view) && !data.values.empty();
  const bool shown = painted || (settings.view == View::kRegions && !data.values.empty());
  if (shown && largest > 0) {
    scale.coloured = true;
    // Of one value an isoline would be all of the surface, as where all distances are 0.
    if (!is_one_value(data)) set_lines(data, settings, painted, scale);
  }
  scale.bar = settings.bar && painted && (largest > 0 || has_range);
  if (!scale.bar) return scale;
  set_ticks(settings, scale);
  const double slack = kSlackOfEnds * (scale.max - scale.min);
  // The distance 0 of sources has no place on a logarithmic scale, and nobody misses it there.
  const double low = scale.kind == ColourScale::kLog ? data.smallest_positive : data.smallest_value;
  scale.below = low < scale.min - slack;
  scale.above = data.greatest_value > scale.max + slack;
  return scale;
}

}  // namespace geotherm::app
