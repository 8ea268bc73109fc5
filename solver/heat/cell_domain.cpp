// SPDX-License-Identifier: MIT
#include "solver/heat/cell_domain.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/accuracy/distance_bounds.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/heat/cell_field.h"
#include "solver/method/marching_method.h"

namespace geotherm {
namespace {

/// Share of the work at which the analysis begins, and ends.
constexpr double kCellsAnalyzedFrom = 0.3, kAnalyzedTo = 0.7;

/// Sizes of the components; the mean edge of one is the mean of its cells' widths.
std::vector<ComponentSize> measure_cells(const CellMesh& mesh) {
  std::vector<ComponentSize> sizes(static_cast<std::size_t>(mesh.components.count));
  for (Index c = 0; c < mesh.cell_count(); ++c) {
    ComponentSize& size = sizes[mesh.components.of[mesh.corners_of(c).front()]];
    ++size.cells;
    size.area += mesh.widths[c] * mesh.widths[c];
  }
  for (std::size_t c = 0; c < sizes.size(); ++c) sizes[c].mean_edge = mesh.mean_width[c];
  return sizes;
}

/// In bodies of the thickness kThickness, in mean widths, t is the square of the mean width; in
/// thinner ones it is at least the share kMinTime of that square, since in irregular meshes
/// distances would become too short.
constexpr double kThickness = 13, kMinTime = 0.6;
/// Below this share of the cube root of the volume a thickness is that of a long or thin body.
constexpr double kLongBody = 0.6;

/// X scatters by the same angles whatever the number of tets, which makes distances too short by a
/// share like h^2 / t; what the border and corners make too long falls like sqrt(t) over the
/// thickness. Both fall with h where t / h^2 follows the thickness in widths to the power of 2/3.
/// The thickness is 3 volumes over the border's area, the radius of a ball, and less in long
/// bodies, whose ways bend more often (docs/domains.md). A vertex's gradients, added up over its
/// tets, leave a third of the border's area around it.
void follow_thickness(CellDomain& domain) {
  const CellMesh& mesh = *domain.mesh;
  std::vector<Vec3> normals(static_cast<std::size_t>(mesh.size()), Vec3::Zero());
  std::vector<double> volume(domain.component_sizes.size(), 0.0), area(volume);
  for (Index c = 0; c < mesh.cell_count(); ++c) {
    const auto corners = mesh.corners_of(c);
    const auto place = [&](std::size_t k) {
      return Vec3(domain.given->positions[domain.vertex_of_row[corners[k % 4]]] / domain.unit);
    };
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 edge = place(k) - place(k + 1);
      const Vec3 normal = (place(k + 2) - place(k + 1)).cross(place(k + 3) - place(k + 1)) / 6;
      const double towards = normal.dot(edge);
      normals[corners[k]] += towards < 0 ? Vec3(-normal) : normal;
      volume[mesh.components.of[corners[k]]] += std::abs(towards) / 4;
    }
  }
  for (Index row = 0; row < mesh.size(); ++row) {
    area[mesh.components.of[row]] += normals[row].norm();
  }
  for (std::size_t c = 0; c < volume.size(); ++c) {
    ComponentSize& size = domain.component_sizes[c];
    const double side = std::cbrt(volume[c]);
    const double of_ball = std::cbrt(36 * std::numbers::pi) * side * side;
    double thickness = 3 * volume[c] / std::max(area[c], of_ball);
    const double roundness = std::min(1.0, thickness / (kLongBody * side));
    thickness *= roundness * roundness;
    const double in_widths = thickness / size.mean_edge;
    size.grading = std::max(kMinTime, std::pow(in_widths / kThickness, 2.0 / 3));
  }
}

/// The first cell of each face at each vertex.
CellTable faces_at_vertices(const CellComplex& given, int threads) {
  return CellTable(given.vertices, given.cell_count(), threads, [&given](Index c) {
    const bool is_first = c == 0 || given.numbers[c] != given.numbers[c - 1];
    return is_first ? given.corners_of(c) : std::span<const Index>();
  });
}

/// Polygons that were flipped have the mean width from before they were refined, of which t is
/// made.
void keep_width_of_flipped(CellDomain& domain) {
  const FlippedPolygons& flipped = *domain.flipped;
  for (Index v = 0; v < domain.input_vertices; ++v) {
    const Index row = domain.row_of_vertex[v], part = flipped.parts.of[v];
    if (row == kNoIndex) continue;
    ComponentSize& size = domain.component_sizes[domain.mesh->components.of[row]];
    size.mean_edge = flipped.mean_width[part];
    size.grading = flipped.grading[part];
  }
}

class CellInput final : public Domain::Input {
 public:
  explicit CellInput(std::shared_ptr<const CellComplex> cells) : cells_(std::move(cells)) {}

  Index cell_count() const override { return cells_->cell_count(); }
  std::array<const char*, 2> cell_names() const override {
    return {cells_->cell_name.c_str(), cells_->cells_name.c_str()};
  }
  Result<std::shared_ptr<const Domain>> make(const Backend& backend, LaplacianKind laplacian,
                                             int threads, const Progress& progress) const override {
    auto fits = refuse_laplacian(laplacian, "these are " + cells_->cells_name);
    if (!fits) return fits.error();
    Stopwatch watch;
    if (!report(progress, "operators", 0.0)) return cancelled_error();
    if (const auto valid = check_cells(*cells_); !valid) return valid.error();
    auto out = std::make_shared<CellDomain>();
    out->given = cells_;
    out->findings = cells_->notes;
    out->input = std::make_shared<const CellInput>(cells_);
    out->unit = std::accumulate(cells_->widths.begin(), cells_->widths.end(), 0.0) /
                static_cast<double>(cells_->cell_count());
    auto flipped = flip_polygons(*cells_, out->unit, threads, progress);
    if (!flipped) return flipped.error();
    out->flipped = *std::move(flipped);
    if (out->flipped) out->faces_at = faces_at_vertices(*cells_, threads);
    const CellComplex& cells = out->cells();
    const CellPattern pattern = pattern_of_cells(cells, threads);
    out->timing.operators = watch.lap();

    std::vector<Vec3> places;
    if (!cells.positions.empty()) {
      for (const Index v : pattern.vertices) places.push_back(cells.positions[v]);
    }
    auto done =
        out->analyze(backend, pattern, places, threads, progress, kCellsAnalyzedFrom, watch);
    if (!done) return done.error();

    const bool has_border =
        std::ranges::count(cells_->on_boundary, 0) != std::ssize(cells_->on_boundary);
    if (cells_->dimension == 3 && has_border) out->auto_boundary = BoundaryRule::kAverage;
    out->mesh = build_cell_mesh(cells, pattern, out->analysis->order(), out->unit, threads);
    out->matrix = out->mesh;
    out->input_vertices = cells_->vertices;
    for (const Index v : out->vertex_of_row) {
      out->on_boundary.push_back(cells.on_boundary.empty() ? 0 : cells.on_boundary[v]);
    }
    out->cell_of_given.resize(out->mesh->given_cell.size());
    for (std::size_t c = 0; c < out->cell_of_given.size(); ++c) {
      out->cell_of_given[out->mesh->given_cell[c]] = static_cast<Index>(c);
    }
    out->component_sizes = measure_cells(*out->mesh);
    if (out->flipped) keep_width_of_flipped(*out);
    if (out->mesh->is_of_tets && !cells_->positions.empty() && cells_->lengths_are_straight) {
      follow_thickness(*out);
    }
    out->timing.operators += watch.lap();
    return std::shared_ptr<const Domain>(std::move(out));
  }

 private:
  std::shared_ptr<const CellComplex> cells_;
};

}  // namespace

std::shared_ptr<const Domain::Input> cell_input(std::shared_ptr<const CellComplex> cells) {
  return std::make_shared<const CellInput>(std::move(cells));
}

Result<void> refuse_laplacian(LaplacianKind laplacian, const std::string& space) {
  if (laplacian == LaplacianKind::kAuto || laplacian == LaplacianKind::kCotan) return {};
  return Error{ErrorCode::kBadInput,
               "the Laplacian " + to_text(laplacian) + " is of triangle meshes, and " + space,
               {"use ", SettingHint{"laplacian", {"auto"}}}};
}

std::shared_ptr<const DomainOperator> MatrixDomain::combine(double mass_factor,
                                                            const PerComponent& stiffness_factor,
                                                            std::vector<Index> held,
                                                            const PerComponent& consistent_share,
                                                            int threads) const {
  return std::make_shared<const CellOperator>(matrix, mass_factor, stiffness_factor,
                                              consistent_share, std::move(held), threads);
}

void MatrixDomain::apply_stiffness(std::span<const double> x, std::span<double> y,
                                   int threads) const {
  geotherm::apply_stiffness(*matrix, x, y, threads);
}

Result<void> MatrixDomain::analyze(const Backend& backend, const CellPattern& pattern,
                                   std::span<const Vec3> places, int threads,
                                   const Progress& progress, double begins, Stopwatch& watch) {
  if (!report(progress, "analyze", begins)) return cancelled_error();
  auto made = backend.analyze(pattern.pattern, places, threads);
  if (!made) return made.error();
  analysis = std::move(*made);
  timing.analyze = watch.lap();
  if (!report(progress, "operators", kAnalyzedTo)) return cancelled_error();
  std::vector<Index> vertices;
  for (const Index i : analysis->order()) vertices.push_back(pattern.vertices[i]);
  number_rows(std::move(vertices), static_cast<Index>(pattern.local.size()));
  return {};
}

void MatrixDomain::bound_by_lines(std::span<const Vec3> positions, std::span<const Vec3> sources,
                                  BelowLine below, int threads, DistanceResult& result) const {
  std::vector<LineSource> lines;
  for (const Vec3& at : sources) lines.push_back({at, at, 0.0});
  geotherm::apply_straight_line_bound(positions, StraightLine(lines, unit), unit, 1,
                                      bound_tolerance(MethodKind::kHeat), below, threads, result);
}

double CellDomain::length_within(Index cell, Index row, Index to) const {
  const Index triangle = flipped ? flipped->triangle_of_cell[mesh->given_cell[cell]] : kNoIndex;
  if (triangle == kNoIndex || row == to) return (place_of(to) - place_of(row)).norm() / unit;
  const Face& corners = flipped->triangles[triangle];
  double least = kUnreached;
  for (int k = 0; k < 3; ++k) {
    const Index a = row_of_vertex[corners[k]], b = row_of_vertex[corners[next_corner(k)]];
    const bool joins = (a == row && b == to) || (a == to && b == row);
    if (joins) least = std::min(least, flipped->lengths[triangle][k]);
  }
  return least;
}

std::unique_ptr<const UnitField> CellDomain::unit_field(const HeatField& heat,
                                                        const PerComponent& t,
                                                        const Workspace& work) const {
  return std::make_unique<const CellField>(*this, heat, t, work);
}

Result<std::vector<NearVertex>> CellDomain::near_field(const SourceAnchors& anchors) const {
  return near_polygons(*this, anchors);
}

void CellDomain::apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                           DistanceResult& result) const {
  if (given->positions.empty() || !given->lengths_are_straight) {
    result.quality.reached_vertices = count_reached(result.distances);
    return;
  }
  std::vector<Vec3> places;
  for (const SurfacePoint& point : sources.points) {
    places.push_back(given->positions[point.vertex]);
  }
  for (const CellPoint& point : sources.cell_points) {
    const auto corners = given->corners_of(find_cell(point.cell));
    const Vec3 first = given->positions[corners.front()];
    Vec3 at = first;
    for (std::size_t k = 1; k < corners.size(); ++k) {
      at += point.weights[k] * (given->positions[corners[k]] - first);
    }
    places.push_back(at);
  }
  bound_by_lines(given->positions, places, below, threads, result);
}

}  // namespace geotherm
