// SPDX-License-Identifier: MIT
#include "app/session/space.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/text/text.h"
#include "geotherm/heat_method.h"

namespace geotherm::app {

Result<std::shared_ptr<const DistanceMethod>> build_method_sharing(const Space& space,
                                                                   const MethodOptions& options,
                                                                   const DistanceMethod* other,
                                                                   const Progress& progress) {
  const HeatMethod* const heat = other != nullptr ? other->heat() : nullptr;
  if (options.method != MethodKind::kHeat || options.refine > 0 || heat == nullptr) {
    return space.build_method(options, progress);
  }
  auto made = heat->with(options, progress);
  if (!made) return made.error();
  return std::shared_ptr<const DistanceMethod>(
      std::make_shared<const HeatMethod>(*std::move(made)));
}

TetSpace::TetSpace(std::shared_ptr<const TetMesh> volume, TetBoundary border,
                   std::vector<char> used)
    : Space({"tets", "tet", "tets", "volume", "border", "mean tet width"}, std::move(used),
            MethodKind::kFastMarching),
      volume_(std::move(volume)),
      border_(std::move(border)) {}

Result<std::shared_ptr<const TetSpace>> TetSpace::build(TetMesh volume) {
  auto border = boundary(volume);
  if (!border) return border.error();
  std::vector<char> used(static_cast<std::size_t>(volume.vertex_count()), 0);
  for (const Tet& tet : volume.tets()) {
    for (const Index v : tet) used[v] = 1;
  }
  return std::shared_ptr<const TetSpace>(new TetSpace(
      std::make_shared<const TetMesh>(std::move(volume)), *std::move(border), std::move(used)));
}

std::vector<Index> TetSpace::corners_of(Index cell) const {
  const Tet& tet = volume_->tets()[static_cast<std::size_t>(cell)];
  return {tet.begin(), tet.end()};
}

std::string TetSpace::described() const {
  return counted(cell_count(), "tet", "tets") + " in a border of " +
         counted(std::ssize(border_.faces), "face", "faces");
}

Result<PlacedPoint> TetSpace::closest_point(const Vec3& place) const {
  const auto found = geotherm::closest_point(*volume_, place);
  if (!found) return found.error();
  PlacedPoint out;
  out.distance = found->distance;
  if (found->point.is_vertex()) {
    out.vertex = found->point.vertex;
  } else {
    const auto& weights = found->point.weights;
    out.in_cell = {found->point.tet, {weights.begin(), weights.end()}};
  }
  return out;
}

Result<std::shared_ptr<const DistanceMethod>> TetSpace::build_method(
    const MethodOptions& options, const Progress& progress) const {
  return geotherm::build_method(volume_, options, progress);
}

Result<void> TetSpace::check_path(const std::string& path) const {
  return check_tet_distances_path(path);
}

Result<void> TetSpace::write(const std::string& path, std::span<const double> distances,
                             std::span<const Index> nearest,
                             std::span<const DataField> fields) const {
  return write_distances(path, *volume_, distances, nearest, fields);
}

namespace {

std::vector<char> corners_in(const CellComplex& cells) {
  std::vector<char> used(static_cast<std::size_t>(cells.vertices), 0);
  for (const Index v : cells.corners) used[static_cast<std::size_t>(v)] = 1;
  return used;
}

/// The polygon that each triangle is a part of; those that were left out have no gradient.
std::vector<Index> polygons_of_triangles(const PolygonMesh& mesh, const CellComplex& cells) {
  std::vector<Index> out;
  for (std::size_t p = 0; p + 1 < mesh.start.size(); ++p) {
    const auto number = static_cast<Index>(p);
    const bool kept = std::ranges::binary_search(cells.numbers, number);
    const std::int64_t triangles = std::max<std::int64_t>(mesh.start[p + 1] - mesh.start[p] - 2, 0);
    out.insert(out.end(), static_cast<std::size_t>(triangles), kept ? number : kNoIndex);
  }
  return out;
}

}  // namespace

CellSpace::CellSpace(const SpaceWords& words, CellComplex cells, TriangleMesh drawn,
                     MethodKind reference_method)
    : Space(words, corners_in(cells), reference_method),
      cells_(std::make_shared<const CellComplex>(std::move(cells))),
      drawn_(std::make_shared<const TriangleMesh>(std::move(drawn))) {}

std::vector<Index> CellSpace::boundary_vertices() const {
  std::vector<Index> out;
  for (Index v = 0; v < cells_->vertices; ++v) {
    if (cells_->on_boundary[static_cast<std::size_t>(v)] != 0) out.push_back(v);
  }
  return out;
}

Result<std::shared_ptr<const DistanceMethod>> CellSpace::build_method(
    const MethodOptions& options, const Progress& progress) const {
  auto made = HeatMethod::build(cells_, options, progress);
  if (!made) return made.error();
  return std::shared_ptr<const DistanceMethod>(
      std::make_shared<const HeatMethod>(*std::move(made)));
}

Result<void> CellSpace::write(const std::string& path, std::span<const double> distances,
                              std::span<const Index> nearest,
                              std::span<const DataField> fields) const {
  return write_distances(path, *drawn_, distances, nearest, fields);
}

PolygonSpace::PolygonSpace(CellComplex cells, TriangleMesh triangles,
                           std::vector<Index> cells_of_faces)
    : CellSpace({"polygons", "polygon", "polygons", "polygon mesh", "triangulation",
                 "mean side of the triangles"},
                std::move(cells), std::move(triangles), MethodKind::kWavefront),
      cells_of_faces_(std::move(cells_of_faces)) {
  const auto& numbers = this->cells().numbers;
  for (std::size_t c = 0; c < numbers.size(); ++c) {
    count_ += c == 0 || numbers[c] != numbers[c - 1] ? 1 : 0;
  }
}

Result<std::shared_ptr<const PolygonSpace>> PolygonSpace::build(const PolygonMesh& mesh) {
  auto cells = cells_of(mesh);
  if (!cells) return cells.error();
  auto triangles = triangulated(mesh);
  if (!triangles) return triangles.error();
  std::vector<Index> of_faces = polygons_of_triangles(mesh, *cells);
  assert(std::ssize(of_faces) == triangles->face_count());
  return std::shared_ptr<const PolygonSpace>(
      new PolygonSpace(*std::move(cells), *std::move(triangles), std::move(of_faces)));
}

Index PolygonSpace::place_of(Index polygon) const {
  const auto& numbers = cells().numbers;
  return static_cast<Index>(std::ranges::lower_bound(numbers, polygon) - numbers.begin());
}

std::vector<Index> PolygonSpace::corners_of(Index cell) const {
  const auto corners = cells().corners_of(place_of(cell));
  return {corners.begin(), corners.end()};
}

std::string PolygonSpace::described() const {
  return counted(cell_count(), "polygon", "polygons") + ", drawn by " +
         counted(drawn()->face_count(), "triangle", "triangles");
}

Result<PlacedPoint> PolygonSpace::closest_point(const Vec3& place) const {
  const auto found = geotherm::closest_point(*drawn(), place);
  if (!found) return found.error();
  PlacedPoint out;
  out.vertex = found->point.vertex;
  if (!found->point.is_vertex()) {
    const auto& weights = found->point.weights;
    const auto corner = std::ranges::max_element(weights) - weights.begin();
    out.vertex = drawn()->faces()[found->point.face][static_cast<std::size_t>(corner)];
  }
  out.distance = (drawn()->positions()[out.vertex] - place).norm();
  return out;
}

Result<std::shared_ptr<const DistanceMethod>> PolygonSpace::build_method(
    const MethodOptions& options, const Progress& progress) const {
  if (options.method != MethodKind::kHeat) {
    return geotherm::build_method(drawn(), options, progress);
  }
  if (options.refine > 0) {
    return Error{ErrorCode::kNotAvailable, "polygons cannot be refined"};
  }
  return CellSpace::build_method(options, progress);
}

Result<void> PolygonSpace::check_path(const std::string& path) const {
  return check_distance_path(path);
}

}  // namespace geotherm::app
