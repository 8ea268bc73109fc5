// SPDX-License-Identifier: MIT
#include "solver/grid/grid_marching.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include "solver/core/stopwatch.h"
#include "solver/grid/grid_march.h"
#include "solver/method/marching_method.h"

namespace geotherm {
namespace {

Result<GridSource> sample_source(const GridLattice& lattice, Index sample, double offset) {
  const Grid& grid = lattice.grid();
  if (sample < 0 || sample >= grid.sample_count() || !(grid.speed(sample) > 0)) {
    return Error{ErrorCode::kBadInput,
                 "source sample " + std::to_string(sample) + " is not there, or does not pass"};
  }
  return GridSource{place_in(lattice, sample), offset, 1 / grid.speed(sample), sample, false, 0};
}

Result<GridSource> point_source(const GridLattice& lattice, const CellPoint& point) {
  if (auto valid = check_cell_point(lattice, point); !valid) return valid.error();
  const GridCell cell = lattice.cell(point.cell);
  const GridPlace low = place_in(lattice, point.cell);
  GridPlace at{};
  for (int k = 0; k < cell.count; ++k) {
    const GridPlace corner = place_in(lattice, cell.corners[k]);
    for (int e = 0; e < lattice.dimension(); ++e) at[e] += point.weights[k] * corner[e];
  }
  for (int e = 0; e < lattice.dimension(); ++e) {  // weights are rounded
    at[e] = std::clamp(at[e], low[e], low[e] + 1);
  }
  return GridSource{at, 0, cell.slowness, point.cell, true, 0};
}

/// Sources that are marched together: many that lie side by side, as of a curve or of the rim, are
/// one front. All others are alone, so that distances are those of the nearest.
std::vector<std::vector<GridSource>> fronts_of(const GridLattice& lattice,
                                               const std::vector<GridSource>& sources) {
  constexpr std::size_t kMaxAlone = 8;
  std::vector<std::vector<GridSource>> fronts;
  std::unordered_multimap<Index, Index> left;  // by sample
  for (const GridSource& source : sources) left.emplace(source.lowest, source.number);
  for (const GridSource& first : sources) {
    std::vector<Index> beside;
    const auto take = [&](Index sample) {
      const auto [begin, end] = left.equal_range(sample);
      for (auto i = begin; i != end; ++i) beside.push_back(i->second);
      left.erase(begin, end);
    };
    take(first.lowest);
    for (std::size_t i = 0; i < beside.size(); ++i) {
      for_samples_around(lattice, sources[beside[i]].lowest, 1, take);
    }
    std::sort(beside.begin(), beside.end());
    for (std::size_t i = 0; i < beside.size(); ++i) {
      if (i == 0 || beside.size() <= kMaxAlone) fronts.emplace_back();
      fronts.back().push_back(sources[beside[i]]);
    }
  }
  // What comes later is left out where it is farther: in the order of a list along a line each
  // would take all that lies ahead.
  const auto scattered = [](const std::vector<GridSource>& front) {
    return static_cast<std::uint32_t>(front.front().number) * 2654435769U;
  };
  std::sort(fronts.begin(), fronts.end(),
            [&](const auto& a, const auto& b) { return scattered(a) < scattered(b); });
  return fronts;
}

Result<GridMarch::Found> march_fronts(const GridLattice& lattice, std::vector<GridSource> sources,
                                      double reach, const Progress& progress) {
  constexpr std::size_t kFrontsOfReport = 256;
  const auto samples = static_cast<std::size_t>(lattice.grid().sample_count());
  for (std::size_t i = 0; i < sources.size(); ++i) sources[i].number = static_cast<Index>(i);
  const auto fronts = fronts_of(lattice, sources);
  GridMarch march(lattice, reach);
  if (fronts.size() == 1 && reach == kUnreached) {
    const auto said = [&](std::int64_t done) {
      return report(progress, "marching", static_cast<double>(done) / double(samples));
    };
    if (!march.march(fronts[0], nullptr, said)) return cancelled_error();
    return march.take();
  }
  GridMarch::Found found{
      std::vector<double>(samples, kUnreached), std::vector<Index>(samples, kNoIndex), {}};
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const auto said = [&](std::int64_t done) {
      const double share = static_cast<double>(done) / static_cast<double>(samples);
      const double all = (static_cast<double>(i) + share) / static_cast<double>(fronts.size());
      return report(progress, "marching", all);
    };
    if (i % kFrontsOfReport == 0 && !said(0)) return cancelled_error();
    if (!march.march(fronts[i], i == 0 ? nullptr : &found, said)) return cancelled_error();
    march.merge(found);
  }
  return found;
}

class GridMarchingMethod final : public MarchingMethod {
 public:
  GridMarchingMethod(GridLattice lattice, double setup_ms, int threads)
      : MarchingMethod(lattice.grid().sample_count(),
                       lattice.grid().sample_count() / double(1 << 20), setup_ms, threads,
                       kNanosecondsOfSample),
        lattice_(std::move(lattice)) {}

 private:
  static constexpr double kNanosecondsOfSample = 500;

  Result<Marched> march(const SourceSet& sources, const Progress& progress) const override {
    if (auto valid = check_space_sources(sources, "samples or points of cells"); !valid) {
      return valid.error();
    }
    std::vector<GridSource> from;
    for (std::size_t i = 0; i < sources.points.size(); ++i) {
      const double offset = sources.offsets.empty() ? 0 : sources.offsets[i];
      auto source = sample_source(lattice_, sources.points[i].vertex, offset);
      if (!source) return source.error();
      from.push_back(*source);
    }
    for (const CellPoint& point : sources.cell_points) {
      auto source = point_source(lattice_, point);
      if (!source) return source.error();
      from.push_back(*source);
    }
    auto found = march_fronts(lattice_, std::move(from), kUnreached, progress);
    if (!found) return found.error();
    return Marched{std::move(found->distances), std::move(found->nearest)};
  }

  double eikonal_error(std::span<const double> distances) const override {
    double error = 0, measure = 0;
    lattice_.for_each_cell(0, lattice_.layer_count(), [&](const GridCell& cell) {
      double square = 0;
      for (int e = 0; e < lattice_.dimension(); ++e) {
        if (cell.axis >= 0 && cell.axis != e) continue;
        double rise = 0;
        for (int k = 0; k < cell.count; ++k) {
          const bool far = cell.count == 2 ? k == 1 : (k >> e & 1) != 0;
          rise += far ? distances[cell.corners[k]] : -distances[cell.corners[k]];
        }
        const double slope = rise * 2 / cell.count / (lattice_.spacing(e) * cell.slowness);
        square += slope * slope;
      }
      if (!std::isfinite(square)) return;
      double size = 1;
      for (int e = 0; e < lattice_.dimension(); ++e) size *= cell.slowness;
      error += size * std::abs(std::sqrt(square) - 1);
      measure += size;
    });
    return measure > 0 ? error / measure : 0.0;
  }

  GridLattice lattice_;
};

}  // namespace

Result<void> check_cell_point(const GridLattice& lattice, const CellPoint& point) {
  if (point.cell < 0 || point.cell >= lattice.grid().sample_count() ||
      !lattice.has_cell(point.cell)) {
    return Error{ErrorCode::kBadInput,
                 "at sample " + std::to_string(point.cell) + " begins no cell"};
  }
  return check_weights(point.weights, std::size_t{1} << lattice.dimension(),
                       "cell " + std::to_string(point.cell));
}

Result<std::shared_ptr<const DistanceMethod>> build_grid_marching(std::shared_ptr<const Grid> grid,
                                                                  int threads,
                                                                  const Progress& progress) {
  if (auto valid = check_grid(*grid); !valid) return valid.error();
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Stopwatch watch;
  GridLattice lattice(std::move(grid));
  return std::shared_ptr<const DistanceMethod>(std::make_shared<const GridMarchingMethod>(
      std::move(lattice), watch.milliseconds(), threads));
}

std::vector<NearSample> march_near(const GridLattice& lattice, std::span<const Index> samples,
                                   std::span<const CellPoint> points, double reach) {
  std::vector<GridSource> from;
  for (const Index sample : samples) {
    if (auto source = sample_source(lattice, sample, 0)) from.push_back(*source);
  }
  for (const CellPoint& point : points) {
    if (auto source = point_source(lattice, point)) from.push_back(*source);
  }
  const auto found = march_fronts(lattice, std::move(from), reach, {});
  std::vector<NearSample> near;
  for (const Index v : found->reached) near.push_back({v, found->distances[v]});
  std::sort(near.begin(), near.end(), [](const NearSample& a, const NearSample& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.sample < b.sample;
  });
  return near;
}

}  // namespace geotherm
