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

Error about_face(std::size_t face, const std::string& what, Hint hint = {}) {
  return {ErrorCode::kBadInput, "lengths: face " + std::to_string(face) + " " + what,
          std::move(hint)};
}

std::string sides_in_words(const Lengths& sides) {
  return "has sides of " + number_text(sides[0]) + ", " + number_text(sides[1]) + " and " +
         number_text(sides[2]);
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

/// Adds a face as a cell. Errors (kBadInput): sides that are no triangle with an area, or with one
/// beyond the range of doubles.
Result<void> add_cell(CellComplex& cells, std::size_t number, const Face& face,
                      const Lengths& opposite) {
  const double longest = std::ranges::max(opposite);
  const int exponent = std::ilogb(longest);  // in such units squares of lengths are doubles
  Lengths in_unit = opposite;
  for (double& length : in_unit) length = std::scalbn(length, -exponent);
  const auto at = laid_out(in_unit);
  const double twice_area = at[1].x() * at[2].y();
  const double longest_in_unit = std::ranges::max(in_unit);
  constexpr double kFlat = 1e-10;  // of the height, as a share of the longest side
  if (!(twice_area > kFlat * longest_in_unit * longest_in_unit)) {
    return about_face(number, sides_in_words(opposite) + ", which are no triangle with an area");
  }
  const double area = std::scalbn(twice_area / 2, 2 * exponent);
  if (!std::isnormal(area)) {
    return about_face(number,
                      sides_in_words(opposite) + ", and an area beyond the range of doubles",
                      {"give lengths in another unit, from 1e-150 to 1e150"});
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d side = at[(k + 2) % 3] - at[(k + 1) % 3];
    cells.gradients.push_back(std::scalbn(-side.y() / twice_area, -exponent));
    cells.gradients.push_back(std::scalbn(side.x() / twice_area, -exponent));
    cells.corners.push_back(face[k]);
  }
  cells.start.push_back(std::ssize(cells.corners));
  cells.measures.push_back(area);
  cells.widths.push_back(longest);
  return {};
}

}  // namespace

LengthSpace::LengthSpace(CellComplex cells, TriangleMesh drawn)
    : CellSpace({"lengths", "face", "faces", "surface", "nothing", "mean longest edge"},
                std::move(cells), std::move(drawn), MethodKind::kHeat) {}

Result<std::shared_ptr<const LengthSpace>> LengthSpace::build(const std::vector<Face>& faces,
                                                              const std::vector<Lengths>& lengths) {
  Index last = kNoIndex;
  for (const Face& face : faces) last = std::max(last, std::ranges::max(face));
  const auto corners = 3 * std::ssize(faces);  // no more vertices are in use, and each takes memory
  if (!faces.empty() && last >= corners) {
    return Error{ErrorCode::kBadInput,
                 "faces: there is a vertex " + std::to_string(last) + ", and " +
                     counted(std::ssize(faces), "face has", "faces have") + " at most " +
                     counted(corners, "vertex", "vertices"),
                 {"number vertices from 0 on without gaps"}};
  }
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
    if (auto added = add_cell(cells, f, faces[f], lengths[f]); !added) return added.error();
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
