// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/geometry/edit.h"
#include "solver/geometry/polygon_fans.h"
#include "solver/heat/cell_domain.h"
#include "solver/heat/face_triangles.h"
#include "solver/method/marching_method.h"

namespace geotherm {
namespace {

Error bad_source(const std::string& message) { return {ErrorCode::kBadInput, message}; }

/// The method that takes offsets on what such cells are made of.
std::optional<MethodKind> method_with_offsets(const CellComplex& cells) {
  if (cells.cells_name == "tets") return MethodKind::kFastMarching;
  if (cells.cells_name == "polygons") return MethodKind::kWavefront;
  return {};
}

/// Checks the sources of a CellComplex.
Result<void> check_cell_sources(const CellDomain& domain, const SourceSet& sources) {
  const CellComplex& cells = *domain.given;
  if (auto valid = check_space_sources(sources, "vertices or points of " + cells.cells_name);
      !valid) {
    return valid;
  }
  for (const SurfacePoint& point : sources.points) {
    if (point.vertex < 0 || point.vertex >= cells.vertices) {
      return bad_source("source vertex " + std::to_string(point.vertex) +
                        " is out of range (0 to " + std::to_string(cells.vertices - 1) + ")");
    }
    if (domain.row_of_vertex[point.vertex] == kNoIndex) {
      return bad_source("source vertex " + std::to_string(point.vertex) + " is in no " +
                        cells.cell_name);
    }
  }
  for (const CellPoint& point : sources.cell_points) {
    const Index cell = domain.find_cell(point.cell);
    if (cell == kNoIndex) {
      const Index last = cells.numbers.empty() ? cells.cell_count() - 1 : cells.numbers.back();
      return bad_source("source " + cells.cell_name + " " + std::to_string(point.cell) +
                        (point.cell >= 0 && point.cell <= last
                             ? " was left out"
                             : " is out of range (0 to " + std::to_string(last) + ")"));
    }
    auto valid = check_weights(point.weights, cells.corners_of(cell).size(),
                               cells.cell_name + " " + std::to_string(point.cell));
    if (!valid) return valid;
  }
  return refuse_offsets(sources, method_with_offsets(cells));
}

using Triangle = std::array<std::size_t, 3>;

/// The triangles that a face of four corners or more was cut into, by the places of its corners in
/// the face.
std::vector<Triangle> cut_triangles(const CellComplex& given, Index cell) {
  std::vector<Triangle> out;
  if (given.virtual_vertices.empty() || given.corners_of(cell).size() == 3) return out;
  const Index number = given.numbers[cell];
  for (; cell < given.cell_count() && given.numbers[cell] == number; ++cell) {
    if (!is_cut(given, cell)) break;
    const auto corners = cut_corners(given, cell);
    if (!corners.empty()) out.push_back({corners[0], corners[1], corners[2]});
  }
  return out;
}

/// Where a point lies that is in one of these triangles between places, or nearly so.
PlaceInTriangle point_in(std::span<const Triangle> triangles, std::span<const Vec3> places,
                         const Vec3& at) {
  std::vector<std::array<Vec3, 3>> corners;
  for (const auto& [a, b, c] : triangles) corners.push_back({places[a], places[b], places[c]});
  return find_triangle(corners, at);
}

/// Which corners of a face that was cut a point in it sees, and how far away they are, along
/// straight lines over its triangles, laid out one beside the other.
class CornersInSight {
 public:
  CornersInSight(std::span<const Triangle> triangles, std::span<const Vec3> places,
                 const PlaceInTriangle& from)
      : triangles_(triangles), places_(places), distances_(places.size(), kUnreached) {
    const Triangle& t = triangles[from.triangle];
    const FaceLayout laid = layout(t[0], t[1], t[2]);
    std::array<Eigen::Vector2d, 3> at = {Eigen::Vector2d(0, 0), Eigen::Vector2d(laid.base, 0),
                                         Eigen::Vector2d(laid.x, laid.height)};
    const Eigen::Vector2d source =
        from.weights[0] * at[0] + from.weights[1] * at[1] + from.weights[2] * at[2];
    for (Eigen::Vector2d& corner : at) corner -= source;
    for (std::size_t k = 0; k < 3; ++k) distances_[t[k]] = at[k].norm();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      look_beyond(t[k], at[k], t[next], at[next], at[k], at[next]);
    }
  }

  /// The distance of each corner from the source; infinite where the corner is hidden from it.
  const std::vector<double>& distances() const { return distances_; }

 private:
  FaceLayout layout(std::size_t a, std::size_t b, std::size_t c) const {
    return lay_out(side_lengths(places_[a], places_[b], places_[c]));
  }

  /// From the point at (0, 0), between the lines to `right` and `left`, over the side from corner a
  /// to b, which runs counterclockwise around it.
  void look_beyond(std::size_t a, const Eigen::Vector2d& at_a, std::size_t b,
                   const Eigen::Vector2d& at_b, const Eigen::Vector2d& right,
                   const Eigen::Vector2d& left) {
    for (const Triangle& t : triangles_) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] != b || t[(k + 1) % 3] != a) continue;
        const std::size_t c = t[(k + 2) % 3];
        const FaceLayout laid = layout(b, a, c);
        const Eigen::Vector2d side = (at_a - at_b).normalized();
        const Eigen::Vector2d at_c =
            at_b + laid.x * side + laid.height * Eigen::Vector2d(-side[1], side[0]);
        const bool beside_right = cross(right, at_c) < 0, beside_left = cross(at_c, left) < 0;
        if (!beside_right && !beside_left) distances_[c] = at_c.norm();
        if (!beside_right) look_beyond(a, at_a, c, at_c, right, beside_left ? left : at_c);
        if (!beside_left) look_beyond(c, at_c, b, at_b, beside_right ? right : at_c, left);
        return;
      }
    }
  }

  std::span<const Triangle> triangles_;
  std::span<const Vec3> places_;
  std::vector<double> distances_;
};

/// Turns sources into anchors.
class CellPlacer {
 public:
  explicit CellPlacer(const CellDomain& domain) : domain_(domain), mesh_(*domain.mesh) {}

  void add_vertex(Index vertex) { anchors_.add_vertex(domain_.row_of_vertex[vertex]); }

  void add_point(const CellPoint& point) {
    const Index cell = domain_.find_cell(point.cell);
    std::vector<Index> rows = domain_.rows_of_given(cell);
    std::vector<Vec3> places = domain_.corner_places(cell);
    std::vector<double> weights(point.weights.begin(), point.weights.end());
    Vec3 at = Vec3::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (weights[k] == 1) return add_vertex(domain_.vertex_of_row[rows[k]]);
      at += weights[k] * places[k];
    }
    std::vector<Triangle> triangles = cut_triangles(*domain_.given, cell);
    const bool was_cut = !triangles.empty();
    if (const Index row = domain_.virtual_row(cell); row != kNoIndex) {
      const std::size_t apex = places.size();
      for (std::size_t k = 0; k < apex; ++k) triangles.push_back({k, (k + 1) % apex, apex});
      places.emplace_back((domain_.place_of(row) - domain_.place_of(rows.front())) / domain_.unit);
      rows.push_back(row);
    }
    std::vector<double> distances;
    for (const Vec3& place : places) distances.push_back((place - at).norm());
    if (!triangles.empty()) {
      const PlaceInTriangle there = point_in(triangles, places, at);
      weights.assign(rows.size(), 0.0);
      for (std::size_t k = 0; k < 3; ++k) weights[triangles[there.triangle][k]] = there.weights[k];
      if (was_cut) distances = CornersInSight(triangles, places, there).distances();
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (was_cut && weights[k] == 1) return add_vertex(domain_.vertex_of_row[rows[k]]);
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (distances[k] < kUnreached) anchors_.add_corner(rows[k], distances[k], weights[k]);
    }
  }

  SourceAnchors finish() const { return anchors_.finish(mesh_.components); }

 private:
  const CellDomain& domain_;
  const CellMesh& mesh_;
  AnchorMap anchors_;
};

}  // namespace

Index CellDomain::find_cell(Index number) const {
  const std::vector<Index>& numbers = given->numbers;
  if (numbers.empty()) return number >= 0 && number < given->cell_count() ? number : kNoIndex;
  const auto at = std::ranges::lower_bound(numbers, number);
  return at != numbers.end() && *at == number ? static_cast<Index>(at - numbers.begin()) : kNoIndex;
}

std::vector<Index> CellDomain::rows_of_given(Index cell) const {
  const auto corners = given->corners_of(cell);
  std::vector<Index> rows(corners.size());
  std::ranges::transform(corners, rows.begin(), [this](Index v) { return row_of_vertex[v]; });
  return rows;
}

Index CellDomain::virtual_row(Index cell) const {
  const Index vertex = flipped ? flipped->virtual_of_cell[cell] : kNoIndex;
  return vertex == kNoIndex ? kNoIndex : row_of_vertex[vertex];
}

std::vector<Vec3> CellDomain::corner_places(Index cell) const {
  const auto corners = given->corners_of(cell);
  std::vector<Vec3> out(corners.size(), Vec3::Zero());
  if (!given->positions.empty() && given->lengths_are_straight) {
    const Vec3& first = given->positions[corners.front()];
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = (given->positions[corners[k]] - first) / unit;
    }
    return out;
  }
  const int d = mesh->dimension;
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  const double* gradient = mesh->gradients_of(cell_of_given[cell]);
  for (Vec3& place : out) {
    std::copy_n(gradient, d, place.data());
    square += place * place.transpose();
    gradient += d;
  }
  const Eigen::Matrix3d inverse = inverse_along(square);
  for (Vec3& place : out) place = inverse * place;
  return out;
}

Result<SourceAnchors> CellDomain::place(const SourceSet& sources) const {
  if (const auto valid = check_cell_sources(*this, sources); !valid) return valid.error();
  CellPlacer placer(*this);
  for (const SurfacePoint& point : sources.points) placer.add_vertex(point.vertex);
  for (const CellPoint& point : sources.cell_points) placer.add_point(point);
  SourceAnchors anchors = placer.finish();
  anchors.cell_points = sources.cell_points;
  return anchors;
}

}  // namespace geotherm
