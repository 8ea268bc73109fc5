// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "geotherm/mesh_report.h"
#include "solver/geometry/delaunay.h"
#include "solver/geometry/face_gradient.h"

namespace geotherm {

std::vector<Vec3> heat_directions(const TriangleMesh& mesh, std::span<const double> log_heat) {
  const std::span<const Vec3> positions = mesh.positions();
  std::vector<Vec3> out;
  out.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (const auto& [a, b, c] : mesh.faces()) {
    const double largest = std::max({log_heat[a], log_heat[b], log_heat[c]});
    if (!std::isfinite(largest)) {
      out.push_back(Vec3::Zero());
      continue;
    }
    // A factor that all corners share does not turn the gradient, and brings u back into range.
    const auto heat = [&](Index v) { return std::exp(log_heat[v] - largest); };
    const Vec3 gradient =
        triangle_gradient({positions[a], positions[b], positions[c]}, {heat(a), heat(b), heat(c)});
    out.push_back(gradient.isZero(0) ? Vec3::Zero() : Vec3(-gradient.stableNormalized()));
  }
  return out;
}

namespace {

std::array<Vec3, 3> corner_places(const TriangleMesh& mesh, const Face& face) {
  const auto positions = mesh.positions();
  return {positions[face[0]], positions[face[1]], positions[face[2]]};
}

/// Whether a triangle has the area that gradients need.
bool has_plane(const std::array<Vec3, 3>& corners) {
  return !triangle_gradient(corners, {0, 1, 0}).isZero(0);
}

bool is_reached(std::span<const double> distances, const Face& face) {
  return std::ranges::all_of(face, [&](Index v) { return std::isfinite(distances[v]); });
}

std::vector<double> face_values(const TriangleMesh& mesh,
                                const std::function<double(Index, const Face&)>& value) {
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) out.push_back(value(f, mesh.faces()[f]));
  return out;
}

std::vector<double> values_of(QualityField field, const TriangleMesh& mesh,
                              const DistanceResult& answer, std::span<const double> error) {
  switch (field) {
    case QualityField::kError:
      assert(error.size() == mesh.positions().size());
      return {error.begin(), error.end()};
    case QualityField::kEikonalError:
      return eikonal_errors(mesh, answer.distances);
    case QualityField::kGradientAngle:
      return angles_between(heat_directions(mesh, answer.log_heat),
                            face_gradients(mesh, answer.distances));
    case QualityField::kLostGradients:
      return lost_gradients(mesh, answer.distances, answer.log_heat);
    case QualityField::kTriangleQuality:
      return triangle_qualities(mesh);
    case QualityField::kNonDelaunay:
      break;
  }
  return non_delaunay_edges(mesh);
}

}  // namespace

bool needs_heat(QualityField field) {
  return field == QualityField::kGradientAngle || field == QualityField::kLostGradients;
}

DataField described(QualityField field) {
  using enum QualityField;
  std::string name = to_text(field);
  std::ranges::replace(name, '-', '_');
  const bool is_count = field == kLostGradients || field == kNonDelaunay;
  return {std::move(name),
          field == kError ? DataField::Place::kVertices : DataField::Place::kFaces,
          is_count ? DataField::Type::kUint8 : DataField::Type::kFloat64,
          {}};
}

DataField quality_field(QualityField field, const TriangleMesh& mesh, const DistanceResult& answer,
                        std::span<const double> error) {
  DataField made = described(field);
  made.values = values_of(field, mesh, answer, error);
  return made;
}

std::vector<double> eikonal_errors(const TriangleMesh& mesh, std::span<const double> distances) {
  const std::vector<Vec3> gradients = face_gradients(mesh, distances);
  return face_values(mesh, [&](Index f, const Face& face) {
    const double slope = gradients[f].stableNorm();
    const bool has_value =
        is_reached(distances, face) && (slope > 0 || has_plane(corner_places(mesh, face)));
    return has_value ? std::abs(slope - 1) : kUnreached;
  });
}

std::vector<double> lost_gradients(const TriangleMesh& mesh, std::span<const double> distances,
                                   std::span<const double> log_heat) {
  const std::vector<Vec3> heat = heat_directions(mesh, log_heat);
  return face_values(mesh, [&](Index f, const Face& face) {
    // Between sources distance is 0, and there is no direction to lose.
    const bool is_source = std::ranges::all_of(face, [&](Index v) { return distances[v] == 0; });
    const bool lost = heat[f].isZero(0) && !is_source && is_reached(distances, face) &&
                      has_plane(corner_places(mesh, face));
    return lost ? 1.0 : 0.0;
  });
}

std::vector<double> triangle_qualities(const TriangleMesh& mesh) {
  return face_values(
      mesh, [&](Index, const Face& face) { return triangle_quality(corner_places(mesh, face)); });
}

std::vector<double> non_delaunay_edges(const TriangleMesh& mesh) {
  std::vector<double> count(static_cast<std::size_t>(mesh.face_count()), 0);
  const CleanFaces clean = clean_faces(mesh);
  const double unit = mean_edge_length(mesh.positions(), clean.edges);
  if (!(unit > 0)) return count;
  const IntrinsicMesh intrinsic =
      build_intrinsic_mesh(mesh.positions(), clean, unit, 1, Strictness::kHeights);
  for (const Side side : non_delaunay_sides(intrinsic)) {
    for (const Side each : {side, intrinsic.twin[side]}) ++count[clean.original[face_of(each)]];
  }
  return count;
}

std::vector<double> angles_between(std::span<const Vec3> a, std::span<const Vec3> b) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  std::vector<double> out(a.size(), kUnreached);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].isZero(0) || b[i].isZero(0)) continue;
    const Vec3 u = a[i].stableNormalized();
    const Vec3 v = b[i].stableNormalized();
    out[i] = 2 * std::atan2((u - v).norm(), (u + v).norm()) * kDegrees;
  }
  return out;
}

}  // namespace geotherm
