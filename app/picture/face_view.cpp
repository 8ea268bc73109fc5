// SPDX-License-Identifier: MIT
#include "app/picture/face_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/picture/ticks.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

/// Errors beyond those of this share of the faces, at sources and creases, have the last colour.
constexpr double kShown = 0.95;
/// An error as large as the gradient itself.
constexpr double kMaxError = 1;

/// A round number that most values are below.
double error_scale(const std::vector<double>& values) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known),
                       [](double x) { return std::isfinite(x); });
  if (known.empty()) return kMaxError;
  const auto place = static_cast<std::ptrdiff_t>(kShown * static_cast<double>(known.size() - 1));
  std::ranges::nth_element(known, known.begin() + place);
  const double most = known[static_cast<std::size_t>(place)];
  return most > 0 ? std::min(round_number_above(most), kMaxError) : kMaxError;
}

double scale_end(QualityField field, const std::vector<double>& values) {
  if (field == QualityField::kNonDelaunay) return 3;
  return field == QualityField::kEikonalError ? error_scale(values) : 1;
}

/// "(12 faces)", which stays on one line.
std::string counted_faces(const std::vector<double>& values) {
  const auto some = std::ranges::count_if(values, [](double x) { return x > 0; });
  return '(' + grouped(some) + (some == 1 ? "\u00a0face)" : "\u00a0faces)");
}

std::string title_of(QualityField field, const std::vector<double>& values) {
  switch (field) {
    case QualityField::kLostGradients:
      return "no heat direction " + counted_faces(values);
    case QualityField::kTriangleQuality:
      return "triangle quality (1:\u00a0equilateral)";
    case QualityField::kNonDelaunay:
      return "edges that are not Delaunay " + counted_faces(values);
    default:
      return "| |\u2207\u03c6| \u2212 1 |";
  }
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
  if (!field) return;
  if (needs_distances(view) && answer == nullptr) return;
  if (needs_heat(*field) && answer->log_heat.empty()) return;
  const DataField made =
      quality_field(*field, mesh, answer != nullptr ? *answer : DistanceResult());
  data.face_values.reserve(made.values.size());
  for (const double x : made.values) {
    data.face_values.push_back(std::isfinite(x) ? static_cast<float>(x) : kNoPictureValue);
  }
  data.largest_face_value = static_cast<float>(scale_end(*field, made.values));
  data.face_view = view;
  data.face_title = title_of(*field, made.values);
}

std::optional<double> face_tick_step(View view) {
  const bool whole = view == View::kLostGradients || view == View::kNonDelaunay;
  return whole ? std::optional<double>(1) : std::nullopt;
}

}  // namespace geotherm::app
