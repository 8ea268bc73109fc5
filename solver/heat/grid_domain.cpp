// SPDX-License-Identifier: MIT
#include "solver/heat/grid_domain.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/accuracy/distance_bounds.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/grid/grid_marching.h"
#include "solver/heat/grid_field.h"
#include "solver/method/marching_method.h"

namespace geotherm {
namespace {

/// Share of the work at which the analysis begins, and ends.
constexpr double kGridAnalyzedFrom = 0.4, kGridAnalyzedTo = 0.7;

/// The time in squares of the spacing where speeds are the same: directions are right for short
/// times, too (GridField::straighten()), and heat turns corners of walls the closer the shorter
/// they are: 3.3 % of error in a maze, in place of 6.4 %. Where speeds differ, slow samples need
/// longer ones: with 1/4 the error of two half planes is 1 % in place of 0.6 %.
constexpr double kOneSpeedTime = 0.25;

class GridInput final : public Domain::Input {
 public:
  explicit GridInput(std::shared_ptr<const GridLattice> lattice) : lattice_(std::move(lattice)) {}

  Index cell_count() const override { return lattice_->cell_count(); }
  std::array<const char*, 2> cell_names() const override { return {"cell", "cells"}; }

  Result<std::shared_ptr<const Domain>> make(const Backend& backend, LaplacianKind laplacian,
                                             int threads, const Progress& progress) const override {
    if (laplacian != LaplacianKind::kAuto && laplacian != LaplacianKind::kCotan) {
      return Error{
          ErrorCode::kBadInput,
          "the Laplacian " + to_text(laplacian) + " is of triangle meshes, and this is a grid",
          {"use ", SettingHint{"laplacian", {"auto"}}}};
    }
    Stopwatch watch;
    if (!report(progress, "operators", 0.0)) return cancelled_error();
    auto out = std::make_shared<GridDomain>();
    out->lattice = lattice_;
    out->input = std::make_shared<const GridInput>(lattice_);
    measure_cells_into(*out);
    GridPattern pattern = pattern_of_grid(*lattice_);
    out->timing.operators = watch.lap();

    if (!report(progress, "analyze", kGridAnalyzedFrom)) return cancelled_error();
    std::vector<Vec3> places;
    if (!backend.iterative()) {
      for (const Index v : pattern.vertices) places.push_back(lattice_->grid().position(v));
    }
    auto analysis = backend.analyze(pattern.pattern, places, threads);
    if (!analysis) return analysis.error();
    out->analysis = std::move(*analysis);
    out->timing.analyze = watch.lap();

    if (!report(progress, "operators", kGridAnalyzedTo)) return cancelled_error();
    const std::span<const Index> order = out->analysis->order();
    out->matrix =
        build_grid_matrix(*lattice_, pattern, order, out->unit, out->mean_measure, threads);
    number_rows(pattern, order, *out);
    measure_components(*out);
    out->timing.operators += watch.lap();
    return std::shared_ptr<const Domain>(std::move(out));
  }

 private:
  /// The mean length and measure of all cells.
  void measure_cells_into(GridDomain& out) const {
    double width = 0, measure = 0;
    lattice_->for_each_cell(0, lattice_->layer_count(), [&](const GridCell& cell) {
      width += lattice_->width(cell) * cell.slowness;
      measure += std::pow(cell.slowness, lattice_->dimension());
    });
    out.unit = width / lattice_->cell_count();
    out.mean_measure = lattice_->measure() * measure / lattice_->cell_count();
  }

  void number_rows(const GridPattern& pattern, std::span<const Index> order,
                   GridDomain& out) const {
    out.input_vertices = lattice_->grid().sample_count();
    out.row_of_vertex.assign(static_cast<std::size_t>(out.input_vertices), kNoIndex);
    const int inside = 1 << lattice_->dimension();
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Index vertex = pattern.vertices[order[k]];
      out.vertex_of_row.push_back(vertex);
      out.row_of_vertex[vertex] = static_cast<Index>(k);
      out.on_boundary.push_back(lattice_->cells_at(vertex) < inside ? 1 : 0);
    }
  }

  void measure_components(GridDomain& out) const {
    out.components.resize(static_cast<std::size_t>(out.matrix->components.count));
    for (ComponentSize& size : out.components) size.mean_edge = 0;
    lattice_->for_each_cell(0, lattice_->layer_count(), [&](const GridCell& cell) {
      ComponentSize& size =
          out.components[out.matrix->components.of[out.row_of_vertex[cell.corners[0]]]];
      const double width = lattice_->width(cell) * cell.slowness / out.unit;
      ++size.cells;
      size.mean_edge += width;
      size.area += width * width;
    });
    for (ComponentSize& size : out.components) {
      size.mean_edge /= size.cells;
      if (lattice_->has_one_speed()) size.grading = kOneSpeedTime;
    }
  }

  std::shared_ptr<const GridLattice> lattice_;
};

Error bad_grid_source(std::string message) { return {ErrorCode::kBadInput, std::move(message)}; }

}  // namespace

Result<std::shared_ptr<const Domain::Input>> grid_input(std::shared_ptr<const Grid> grid) {
  if (auto valid = check_grid(*grid); !valid) return valid.error();
  return std::shared_ptr<const Domain::Input>(
      std::make_shared<const GridInput>(std::make_shared<const GridLattice>(std::move(grid))));
}

std::shared_ptr<const DomainOperator> GridDomain::combine(double mass_factor,
                                                          const PerComponent& stiffness_factor,
                                                          std::vector<Index> held,
                                                          const PerComponent& consistent_share,
                                                          int threads) const {
  return std::make_shared<const CellOperator>(matrix, mass_factor, stiffness_factor,
                                              consistent_share, std::move(held), threads);
}

void GridDomain::apply_stiffness(std::span<const double> x, std::span<double> y,
                                 int threads) const {
  geotherm::apply_stiffness(*matrix, x, y, threads);
}

Result<SourceAnchors> GridDomain::place(const SourceSet& sources) const {
  if (auto valid = check_space_sources(sources, "samples or points of cells"); !valid) {
    return valid.error();
  }
  if (auto none = refuse_offsets(sources); !none) return none.error();
  AnchorMap anchors;
  for (const SurfacePoint& point : sources.points) {
    if (point.vertex < 0 || point.vertex >= input_vertices) {
      return bad_grid_source("source sample " + std::to_string(point.vertex) +
                             " is out of range (0 to " + std::to_string(input_vertices - 1) + ")");
    }
    if (row_of_vertex[point.vertex] == kNoIndex) {
      return bad_grid_source("nothing passes at the source sample " + std::to_string(point.vertex));
    }
    anchors.add_vertex(row_of_vertex[point.vertex]);
  }
  const int d = lattice->dimension();
  for (const CellPoint& point : sources.cell_points) {
    if (auto valid = check_cell_point(*lattice, point); !valid) return valid.error();
    const GridCell cell = lattice->cell(point.cell);
    std::array<double, 3> at{};
    for (int k = 0; k < cell.count; ++k) {
      for (int e = 0; e < d; ++e) at[e] += (k >> e & 1) * point.weights[k];
    }
    for (int k = 0; k < cell.count; ++k) {
      const Index row = row_of_vertex[cell.corners[k]];
      if (point.weights[k] == 1) anchors.add_vertex(row);
      double square = 0;
      for (int e = 0; e < d; ++e) {
        const double along = (at[e] - (k >> e & 1)) * lattice->spacing(e);
        square += along * along;
      }
      anchors.add_corner(row, std::sqrt(square) * cell.slowness / unit, point.weights[k]);
    }
  }
  SourceAnchors out = anchors.finish(matrix->components);
  out.cell_points = sources.cell_points;
  return out;
}

std::unique_ptr<const UnitField> GridDomain::unit_field(const HeatField& heat,
                                                        const PerComponent& t,
                                                        const Workspace& work) const {
  return std::make_unique<const GridField>(*this, heat, t, work);
}

void GridDomain::apply_straight_line_bound(const SourceSet& sources, BelowLine below, int threads,
                                           DistanceResult& result) const {
  if (!lattice->is_uniform()) {  // travel time is no length
    result.quality.reached_vertices = count_reached(result.distances);
    return;
  }
  const Grid& grid = lattice->grid();
  const auto place_of = [&grid](Index sample) {  // from the origin, which may be far away
    const auto at = grid.place(sample);
    return Vec3(at[0] * grid.spacing[0], at[1] * grid.spacing[1], at[2] * grid.spacing[2]);
  };
  std::vector<LineSource> lines;
  for (const SurfacePoint& point : sources.points) {
    const Vec3 at = place_of(point.vertex);
    lines.push_back({at, at, 0.0});
  }
  for (const CellPoint& point : sources.cell_points) {
    const GridCell cell = lattice->cell(point.cell);
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < cell.count; ++k) at += point.weights[k] * place_of(cell.corners[k]);
    lines.push_back({at, at, 0.0});
  }
  std::vector<Vec3> positions(static_cast<std::size_t>(input_vertices));
  for (Index v = 0; v < input_vertices; ++v) positions[v] = place_of(v);
  geotherm::apply_straight_line_bound(positions, StraightLine(lines, unit), unit, 1,
                                      bound_tolerance(MethodKind::kHeat), below, threads, result);
}

}  // namespace geotherm
