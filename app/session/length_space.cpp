// SPDX-License-Identifier: MIT
#include "app/session/length_space.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

using Lengths = std::array<double, 3>;

/// Lengths of one edge that differ by less are one: what is written with seven digits.
constexpr double kSameLength = 1e-6;

struct KnownEdge {
  double length = 0;
  Index faces = 0;
};
using KnownEdges = std::map<std::array<Index, 2>, KnownEdge>;

Error about_face(std::size_t face, const std::string& what) {
  return {ErrorCode::kBadInput, "lengths: face " + std::to_string(face) + " " + what};
}

Result<KnownEdges> edges_of(const std::vector<Face>& faces, const std::vector<Lengths>& lengths) {
  KnownEdges edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = faces[f][(k + 1) % 3], b = faces[f][(k + 2) % 3];
      const double length = lengths[f][k];
      if (a == b) return about_face(f, "repeats the corner " + std::to_string(a));
      if (!(length > 0) || !std::isfinite(length)) {
        return about_face(f, "has a side of length " + number_text(length));
      }
      KnownEdge& edge = edges[{std::min(a, b), std::max(a, b)}];
      if (edge.faces++ == 0) edge.length = length;
      if (std::abs(edge.length - length) <= kSameLength * length) continue;
      return about_face(f, "gives the edge from vertex " + std::to_string(a) + " to " +
                               std::to_string(b) + " the length " + number_text(length) +
                               ", another face " + number_text(edge.length));
    }
  }
  return edges;
}

/// Corners of a triangle with these sides, in its own plane: the first at the origin.
std::array<Eigen::Vector2d, 3> laid_out(const Lengths& opposite) {
  const auto [a, b, c] = opposite;
  const double x = (b * b + c * c - a * a) / (2 * c);
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(c, 0),
          Eigen::Vector2d(x, std::sqrt(std::max(b * b - x * x, 0.0)))};
}

/// Adds a face as a cell; false where its sides are no triangle with an area.
bool add_cell(CellComplex& cells, const Face& face, const Lengths& opposite) {
  const auto at = laid_out(opposite);
  const double twice_area = at[1].x() * at[2].y();
  const double longest = std::ranges::max(opposite);
  constexpr double kFlat = 1e-10;  // of the height, as a share of the longest side
  if (!(twice_area > kFlat * longest * longest)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d side = at[(k + 2) % 3] - at[(k + 1) % 3];
    cells.gradients.push_back(-side.y() / twice_area);
    cells.gradients.push_back(side.x() / twice_area);
    cells.corners.push_back(face[k]);
  }
  cells.start.push_back(std::ssize(cells.corners));
  cells.measures.push_back(twice_area / 2);
  cells.widths.push_back(longest);
  return true;
}

}  // namespace

LengthSpace::LengthSpace(CellComplex cells, TriangleMesh drawn)
    : CellSpace({"lengths", "face", "faces", "surface", "nothing", "mean longest edge"},
                std::move(cells), std::move(drawn), MethodKind::kHeat) {}

Result<std::shared_ptr<const LengthSpace>> LengthSpace::build(const std::vector<Face>& faces,
                                                              const std::vector<Lengths>& lengths) {
  Index last = kNoIndex;
  for (const Face& face : faces) last = std::max(last, std::ranges::max(face));
  auto drawn = TriangleMesh::build(
      std::vector<Vec3>(static_cast<std::size_t>(last) + 1, Vec3::Zero()), faces);
  if (!drawn) return drawn.error();
  const auto edges = edges_of(faces, lengths);
  if (!edges) return edges.error();
  CellComplex cells;
  cells.vertices = last + 1;
  cells.dimension = 2;
  cells.start = {0};
  cells.cell_name = "face";
  cells.cells_name = "faces";
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (add_cell(cells, faces[f], lengths[f])) continue;
    return about_face(f, "has sides of " + number_text(lengths[f][0]) + ", " +
                             number_text(lengths[f][1]) + " and " + number_text(lengths[f][2]) +
                             ", which are no triangle with an area");
  }
  cells.on_boundary.assign(static_cast<std::size_t>(cells.vertices), 0);
  for (const auto& [ends, edge] : *edges) {
    if (edge.faces == 1) cells.on_boundary[ends[0]] = cells.on_boundary[ends[1]] = 1;
  }
  return std::shared_ptr<const LengthSpace>(new LengthSpace(std::move(cells), *std::move(drawn)));
}

std::vector<Index> LengthSpace::corners_of(Index cell) const {
  const auto corners = cells().corners_of(cell);
  return {corners.begin(), corners.end()};
}

std::string LengthSpace::described() const {
  return counted(cell_count(), "face", "faces") + " by the lengths of their edges";
}

std::vector<SpaceFigure> LengthSpace::figures() const {
  const double area = std::accumulate(cells().measures.begin(), cells().measures.end(), 0.0);
  return {{"area", significant(area), "area", area}};
}

std::vector<Index> LengthSpace::cells_of_faces() const {
  std::vector<Index> all(static_cast<std::size_t>(cell_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Vec3 LengthSpace::gradient_on(Index cell, std::span<const double> values) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double* const at = cells().gradients.data() + 6 * static_cast<std::size_t>(cell) + 2 * k;
    sum += values[k] * Vec3(at[0], at[1], 0);
  }
  return sum;
}

Result<PlacedPoint> LengthSpace::closest_point(const Vec3&) const {
  return Error{ErrorCode::kBadInput,
               "a surface of edge lengths lies nowhere, so that no point of it is near a place",
               {"name vertices"}};
}

Result<std::shared_ptr<const DistanceMethod>> LengthSpace::build_method(
    const MethodOptions& options, const Progress& progress) const {
  if (options.method != MethodKind::kHeat || options.refine > 0) {
    return Error{ErrorCode::kNotAvailable,
                 "a surface of edge lengths has the heat method alone, on its own triangles",
                 {"take ", SettingHint{"method", {"heat"}}, " and ", SettingHint{"refine", {"0"}}}};
  }
  return CellSpace::build_method(options, progress);
}

Result<void> LengthSpace::check_path(const std::string& path) const {
  const std::string extension = io::file_extension(path);
  if (extension == ".csv" || extension == ".npy") return {};
  return Error{ErrorCode::kNotAvailable,
               one_line(path) + ": distances of edge lengths are written as .csv or .npy"};
}

}  // namespace geotherm::app
