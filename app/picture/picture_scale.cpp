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

/// A value for each tet, where the view is about gradients in tets; empty where it is about faces.
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

std::string colour_map_of(const PictureData& data, const PictureDataSettings& settings) {
  // From near red to far blue is for distances: there is nothing wrong with a red face.
  if (face_field(settings.view)) {
    return settings.colour_map == PictureDataSettings().colour_map ? "viridis"
                                                                   : settings.colour_map;
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

Result<void> check_scale_of_view(const PictureSettings& settings, bool differences) {
  const View view = settings.view;
  const bool is_error = view == View::kExactError;
  if (settings.colour_scale == ColourScale::kDiverging && !is_error &&
      !(differences && maps_values(view))) {
    return Error{ErrorCode::kBadInput,
                 "colour-scale diverging is for differences, and the view " +
                     geotherm::to_text(view) + " shows none",
                 {"choose ", SettingHint{"view", {"exact-error"}}, ", or another scale"}};
  }
  if (settings.colour_scale == ColourScale::kLog && !maps_values(view)) {
    return Error{ErrorCode::kBadInput,
                 "colour-scale log is for distances, which the view " + geotherm::to_text(view) +
                     " does not show in colours",
                 {"choose ", SettingHint{"view", {"contours"}}}};
  }
  if (settings.colour_scale != ColourScale::kLog || !is_error) return {};
  return Error{
      ErrorCode::kBadInput,
      "colour-scale log: the errors of the view exact-error have both signs and no logarithm",
      {"choose ", SettingHint{"colour-scale", {"diverging"}}, ", or another view"}};
}

bool shows_arrows(View view) { return view == View::kHeatGradient || view == View::kGradientError; }

bool needs_fields(View view) {
  const auto field = face_field(view);
  return shows_arrows(view) || (field && needs_heat(*field));
}

bool shows_regions(const PictureData& data, const PictureDataSettings& settings) {
  return settings.view == View::kRegions && !data.nearest.empty();
}

bool shows_line(const PictureDataSettings& settings, const std::string& name) {
  if (settings.path_kind == PathKind::kAll || !parse<PathKind>(name)) return true;
  return name == geotherm::to_text(settings.path_kind);
}

std::string bar_title(const PictureData& data, const PictureSettings& settings) {
  const bool of_faces = face_field(settings.view).has_value();
  std::string title = of_faces ? data.face_title : data.value_title;
  if (settings.bar_label.empty() && (of_faces || settings.units.empty())) return title;
  // Units of the model make room for those that were asked for.
  for (const char* own : {" (model\u00a0units)", " (time\u00a0units)"}) {
    if (title.ends_with(own)) title.erase(title.size() - std::string_view(own).size());
  }
  if (!settings.bar_label.empty()) title = settings.bar_label;
  return settings.units.empty() ? title : title + " (" + settings.units + ")";
}

}  // namespace geotherm::app
