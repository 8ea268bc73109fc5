// SPDX-License-Identifier: MIT
#include "app/picture/picture_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "app/text/text.h"

namespace geotherm::app {
namespace {

/// Errors beyond those of this share of the faces, at sources and creases, have the last colour.
constexpr double kShown = 0.95;
/// An error as large as the gradient itself.
constexpr double kMaxError = 1;

/// A round number that most values are below.
double error_scale(std::span<const double> values) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known),
                       [](double x) { return std::isfinite(x); });
  if (known.empty()) return kMaxError;
  const auto place = static_cast<std::ptrdiff_t>(kShown * static_cast<double>(known.size() - 1));
  std::ranges::nth_element(known, known.begin() + place);
  const double most = known[static_cast<std::size_t>(place)];
  return most > 0 ? std::min(round_number_above(most), kMaxError) : kMaxError;
}

double scale_end(QualityField field, std::span<const double> values) {
  if (field == QualityField::kNonDelaunay) return 3;
  return field == QualityField::kEikonalError ? error_scale(values) : 1;
}

/// "(12 faces)", which stays on one line.
std::string counted_cells(std::span<const double> values, const std::string& cell) {
  const auto some = std::ranges::count_if(values, [](double x) { return x > 0; });
  return '(' + grouped(some) + "\u00a0" + cell + (some == 1 ? ")" : "s)");
}

/// Of the tets, where a view is about the gradients in them; empty where it is about faces.
std::vector<double> values_of_tets(QualityField field, const TetMesh& volume,
                                   const DistanceResult& answer) {
  std::vector<double> out;
  const std::vector<Vec3> gradients = tet_gradients(volume, answer.distances);
  if (field == QualityField::kEikonalError) {
    for (const Vec3& gradient : gradients) {
      out.push_back(gradient.isZero(0) ? kUnreached : std::abs(gradient.norm() - 1));
    }
  }
  if (field != QualityField::kLostGradients) return out;
  const std::vector<Vec3> heat = tet_heat_directions(volume, answer.log_heat);
  for (std::size_t t = 0; t < heat.size(); ++t) {
    out.push_back(heat[t].isZero(0) && !gradients[t].isZero(0) ? 1 : 0);
  }
  return out;
}

std::string title_of(QualityField field, std::span<const double> values, const std::string& cell) {
  switch (field) {
    case QualityField::kLostGradients:
      return "no heat direction " + counted_cells(values, cell);
    case QualityField::kTriangleQuality:
      return "triangle quality (1:\u00a0equilateral)";
    case QualityField::kNonDelaunay:
      return "edges that are not Delaunay " + counted_cells(values, cell);
    default:
      return "| |\u2207\u03c6| \u2212 1 |";
  }
}

std::vector<float> to_picture_values(std::span<const double> values) {
  std::vector<float> out;
  out.reserve(values.size());
  for (const double x : values) {
    out.push_back(std::isfinite(x) ? static_cast<float>(x) : kNoPictureValue);
  }
  return out;
}

}  // namespace

std::optional<QualityField> face_field(View view) {
  switch (view) {
    case View::kEikonalError:
      return QualityField::kEikonalError;
    case View::kLostGradients:
      return QualityField::kLostGradients;
    case View::kTriangleQuality:
      return QualityField::kTriangleQuality;
    case View::kNonDelaunay:
      return QualityField::kNonDelaunay;
    default:
      return std::nullopt;
  }
}

bool needs_distances(View view) {
  return view == View::kEikonalError || view == View::kLostGradients;
}

void set_face_values(PictureData& data, const TriangleMesh& mesh, View view,
                     const DistanceResult* answer) {
  const auto field = face_field(view);
  const bool is_there = !data.face_values.empty() && data.face_view == view;
  if (field && is_there && !needs_distances(view)) return;
  data.face_values.clear();
  data.tet_values.clear();
  if (!field) return;
  if (needs_distances(view) && answer == nullptr) return;
  if (needs_heat(*field) && answer->log_heat.empty()) return;
  const bool of_tets = data.volume && needs_distances(view);
  const std::vector<double> made =
      of_tets ? values_of_tets(*field, *data.volume, *answer)
              : quality_field(*field, mesh, answer != nullptr ? *answer : DistanceResult()).values;
  (of_tets ? data.tet_values : data.face_values) = to_picture_values(made);
  if (of_tets) show_tets(data);
  data.largest_face_value = static_cast<float>(scale_end(*field, made));
  data.face_view = view;
  data.face_title = title_of(*field, made, of_tets ? "tet" : "face");
}

void set_face_values(PictureData& data, View view, std::span<const double> values,
                     std::span<const Index> cells, const std::string& name) {
  const QualityField field = *face_field(view);
  std::vector<double> once;
  for (std::size_t f = 0; f < values.size(); ++f) {
    if (cells[f] != kNoIndex && (f == 0 || cells[f] != cells[f - 1])) once.push_back(values[f]);
  }
  data.tet_values.clear();
  data.face_values = to_picture_values(values);
  data.largest_face_value = static_cast<float>(scale_end(field, once));
  data.face_view = view;
  data.face_title = title_of(field, once, name);
}

std::optional<double> face_tick_step(View view) {
  const bool whole = view == View::kLostGradients || view == View::kNonDelaunay;
  return whole ? std::optional<double>(1) : std::nullopt;
}

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

namespace {

constexpr std::array kMantissas = {"1", "2", "2.5", "5"};
constexpr double kBands = 20;
/// Shares of a step that rounding may take from a tick at the end of its range.
constexpr double kSlack = 1e-6;
/// Labels from here on are written with a power of ten.
constexpr int kLargePower = 6;
constexpr int kSmallPower = -4;
constexpr int kMaxDecimals = 12;

/// m * 10^power as the double next to it, which a product would miss.
double decimal(const char* mantissa, int power) {
  return number_in<double>(mantissa + ("e" + std::to_string(power))).value_or(0);
}

/// The power of ten of x's first digit; right for numbers near the ends of the range too.
int power_of(double x) { return static_cast<int>(std::floor(std::log10(x))); }

/// All round numbers about x, ascending.
std::vector<double> round_numbers_about(double x) {
  std::vector<double> out;
  const int power = power_of(x);
  for (int p = power - 1; p <= power + 1; ++p) {
    for (const char* mantissa : kMantissas) {
      const double value = decimal(mantissa, p);
      if (value > 0) out.push_back(value);
    }
  }
  return out;
}

/// Decimals that show multiples of `step` without rounding.
int decimals_of(double step) {
  for (int decimals = 0; decimals < kMaxDecimals; ++decimals) {
    const double scaled = step * std::pow(10.0, decimals);
    if (scaled >= 0.5 && std::abs(scaled - std::round(scaled)) <= kSlack * scaled) return decimals;
  }
  return kMaxDecimals;
}

void add_labels(Ticks& ticks) {
  double largest = 0;
  for (const double value : ticks.values) largest = std::max(largest, std::abs(value));
  int power = largest > 0 ? power_of(largest * (1 + kSlack)) : 0;
  if (power < kLargePower && power >= kSmallPower) power = 0;
  // In two factors: 10^-power alone may lie outside the range of doubles.
  const auto scaled = [power](double value) {
    const int half = power / 2;
    return value * std::pow(10.0, -half) * std::pow(10.0, half - power);
  };
  const int decimals = decimals_of(scaled(ticks.step));
  for (const double value : ticks.values) {
    std::string label = value == 0 ? "0" : fixed(scaled(value), decimals);
    if (power != 0 && value != 0) label += "e" + std::to_string(power);
    ticks.labels.push_back(std::move(label));
  }
}

/// How many multiples of `step` lie in the range.
double count_of(double min, double max, double step) {
  return std::floor(max / step + kSlack) - std::ceil(min / step - kSlack) + 1;
}

/// The smallest multiple of the spacing with at most `most` ticks, round where the spacing is.
double multiple_of(double spacing, double min, double max, int most) {
  const auto is_round = [](double x) {
    return std::abs(nearest_round_number(x) - x) <= kSlack * x;
  };
  double ten = 1;
  for (int power = 0; power < 4; ++power, ten *= 10) {
    for (const double digit : {1.0, 2.0, 4.0, 5.0}) {
      const double step = digit * ten * spacing;
      if (is_round(spacing) && !is_round(step)) continue;
      if (count_of(min, max, step) <= most)
        return is_round(step) ? nearest_round_number(step) : step;
    }
  }
  return 0;
}

}  // namespace

double nearest_round_number(double x) {
  double best = 0;
  double least = 0;
  for (const double value : round_numbers_about(x)) {
    const double away = std::abs(std::log(value / x));
    if (best > 0 && away >= least) continue;
    best = value;
    least = away;
  }
  return best > 0 ? best : x;
}

double round_number_above(double x) {
  for (const double value : round_numbers_about(x)) {
    if (value >= x * (1 - kSlack)) return value;
  }
  return x;
}

double round_spacing(double range) {
  if (!(range > 0) || !std::isfinite(range)) return 1;
  const double spacing = nearest_round_number(range / kBands);
  return spacing > 0 ? spacing : range;
}

Ticks make_ticks(double min, double max, int most, double spacing) {
  Ticks ticks;
  if (!(max > min) || !std::isfinite(max - min)) return ticks;
  if (spacing > 0) ticks.step = multiple_of(spacing, min, max, most);
  if (!(ticks.step > 0) || count_of(min, max, ticks.step) < 2) {
    ticks.step = round_number_above((max - min) / most);
    while (count_of(min, max, ticks.step) > most) {
      ticks.step = round_number_above(ticks.step * 1.5);
    }
  }
  const double first = std::ceil(min / ticks.step - kSlack);
  const int count = static_cast<int>(count_of(min, max, ticks.step));
  for (int i = 0; i < count; ++i) {
    const double value = (first + i) * ticks.step;
    ticks.values.push_back(value == 0 ? 0.0 : value);
  }
  add_labels(ticks);
  return ticks;
}

}  // namespace geotherm::app
