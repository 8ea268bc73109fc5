// SPDX-License-Identifier: MIT
#include "solver/heat/grid_domain.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/grid/grid_marching.h"
#include "solver/heat/grid_field.h"
#include "solver/method/marching_method.h"

namespace geotherm {
namespace {

/// Share of the work at which the analysis begins.
constexpr double kGridAnalyzedFrom = 0.4;

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
    if (auto fits = refuse_laplacian(laplacian, "this is a grid"); !fits) return fits.error();
    Stopwatch watch;
    if (!report(progress, "operators", 0.0)) return cancelled_error();
    auto out = std::make_shared<GridDomain>();
    out->lattice = lattice_;
    out->input = std::make_shared<const GridInput>(lattice_);
    measure_cells_into(*out);
    const CellPattern pattern = pattern_of_grid(*lattice_);
    out->timing.operators = watch.lap();

    std::vector<Vec3> places;
    if (!backend.iterative()) {
      for (const Index v : pattern.vertices) places.push_back(lattice_->grid().position(v));
    }
    auto done = out->analyze(backend, pattern, places, threads, progress, kGridAnalyzedFrom, watch);
    if (!done) return done.error();

    out->matrix = build_grid_matrix(*lattice_, pattern, out->analysis->order(), out->unit,
                                    out->mean_measure, threads);
    out->input_vertices = lattice_->grid().sample_count();
    const int inside = 1 << lattice_->dimension();
    for (const Index v : out->vertex_of_row) {
      out->on_boundary.push_back(lattice_->cells_at(v) < inside ? 1 : 0);
    }
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

  void measure_components(GridDomain& out) const {
    out.component_sizes.resize(static_cast<std::size_t>(out.matrix->components.count));
    for (ComponentSize& size : out.component_sizes) size.mean_edge = 0;
    lattice_->for_each_cell(0, lattice_->layer_count(), [&](const GridCell& cell) {
      ComponentSize& size =
          out.component_sizes[out.matrix->components.of[out.row_of_vertex[cell.corners[0]]]];
      const double width = lattice_->width(cell) * cell.slowness / out.unit;
      ++size.cells;
      size.mean_edge += width;
      size.area += width * width;
    });
    for (ComponentSize& size : out.component_sizes) {
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

Result<SourceAnchors> GridDomain::place(const SourceSet& sources) const {
  if (auto valid = check_space_sources(sources, "samples or points of cells"); !valid) {
    return valid.error();
  }
  if (auto none = refuse_offsets(sources, MethodKind::kFastMarching); !none) return none.error();
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
  std::vector<Vec3> places;
  for (const SurfacePoint& point : sources.points) places.push_back(place_of(point.vertex));
  for (const CellPoint& point : sources.cell_points) {
    const GridCell cell = lattice->cell(point.cell);
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < cell.count; ++k) at += point.weights[k] * place_of(cell.corners[k]);
    places.push_back(at);
  }
  std::vector<Vec3> positions(static_cast<std::size_t>(input_vertices));
  for (Index v = 0; v < input_vertices; ++v) positions[v] = place_of(v);
  bound_by_lines(positions, places, below, threads, result);
}

}  // namespace geotherm
