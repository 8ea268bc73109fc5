// SPDX-License-Identifier: MIT
#include "solver/volume/tet_marching_method.h"

#include <algorithm>
#include <cmath>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/method/solve_sets.h"
#include "solver/volume/clean_tets.h"
#include "solver/volume/fast_marching_tets.h"

namespace geotherm {
namespace {

/// The sources as points of the volume. Errors: what only triangle meshes have.
Result<std::vector<VolumePoint>> volume_points(const SourceSet& sources) {
  std::vector<VolumePoint> out;
  for (const SurfacePoint& point : sources.points) {
    if (!point.is_vertex()) {
      return Error{ErrorCode::kBadInput,
                   "points in faces are sources of triangle meshes alone; give vertices or points "
                   "of tets"};
    }
    out.push_back(VolumePoint::at_vertex(point.vertex));
  }
  if (!sources.edges.empty()) {
    return Error{ErrorCode::kBadInput, "curves of mesh edges are sources of triangle meshes alone"};
  }
  for (const CellPoint& point : sources.cell_points) {
    if (point.weights.size() != 4) {
      return Error{ErrorCode::kBadInput, "the source in tet " + std::to_string(point.cell) +
                                             " has " + std::to_string(point.weights.size()) +
                                             " weights; a tet has 4 corners"};
    }
    VolumePoint& to = out.emplace_back();
    to.tet = point.cell;
    std::ranges::copy(point.weights, to.weights.begin());
  }
  return out;
}

class TetMarchingMethod final : public DistanceMethod {
 public:
  TetMarchingMethod(std::shared_ptr<const TetMesh> mesh, TetFastMarching marching,
                    std::int64_t bytes, double setup_ms, int threads, double nanoseconds)
      : mesh_(std::move(mesh)),
        marching_(std::move(marching)),
        bytes_(bytes),
        threads_{threads, nanoseconds} {
    timing_.operators = timing_.setup = setup_ms;
    for (const std::string& note : marching_.notes()) warnings_.push_back({note});
  }

  MethodKind kind() const override { return MethodKind::kFastMarching; }

  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress) const override {
    const auto one = [&](const SourceSet& sources, const Progress& part) -> Result<DistanceResult> {
      return solve_one(sources, query, part);
    };
    return solve_sets(sets, threads_, progress, one);
  }

  const SetupTiming& timing() const override { return timing_; }
  double memory_mb() const override { return static_cast<double>(bytes_) / (1 << 20); }
  const std::vector<Warning>& warnings() const override { return warnings_; }

 private:
  Result<DistanceResult> solve_one(const SourceSet& sources, const QueryOptions& query,
                                   const Progress& progress) const {
    const Stopwatch watch;
    const auto points = volume_points(sources);
    if (!points) return points.error();
    // Offsets stand for the points of SourceSet::points; points of cells have none.
    std::vector<double> offsets = sources.offsets;
    if (!offsets.empty()) offsets.resize(points->size(), 0.0);
    auto solved = marching_.solve(*points, offsets, {}, progress);
    if (!solved) return solved.error();
    DistanceResult result;
    result.distances = std::move(solved->distances);
    if (query.nearest) result.nearest_source = std::move(solved->nearest);
    result.quality.reached_vertices = static_cast<Index>(std::ranges::count_if(
        result.distances, [](double distance) { return distance < kUnreached; }));
    result.timing.query = watch.milliseconds();
    if (query.quality) result.quality.eikonal_error_mean = eikonal_error(result.distances);
    return result;
  }

  /// By volume, over the tets whose corners are all reached.
  double eikonal_error(std::span<const double> distances) const {
    const auto positions = mesh_->positions();
    double error = 0, volume = 0;
    for (const Tet& tet : mesh_->tets()) {
      const TetGradient element =
          tet_gradient(positions[tet[0]], positions[tet[1]], positions[tet[2]], positions[tet[3]]);
      Vec3 gradient = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k) gradient += distances[tet[k]] * element.gradients[k];
      if (!(element.volume > 0) || !gradient.allFinite()) continue;
      error += element.volume * std::abs(gradient.norm() - 1);
      volume += element.volume;
    }
    return volume > 0 ? error / volume : 0.0;
  }

  std::shared_ptr<const TetMesh> mesh_;
  TetFastMarching marching_;
  std::int64_t bytes_;
  SetThreads threads_;
  SetupTiming timing_;
  std::vector<Warning> warnings_;
};

}  // namespace

Result<std::shared_ptr<const DistanceMethod>> build_tet_marching(
    std::shared_ptr<const TetMesh> mesh, int threads, const Progress& progress) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Stopwatch watch;
  constexpr std::int64_t kBytesOfTet = 35;
  const std::int64_t bytes = kBytesOfTet * mesh->tet_count();
  constexpr double kNanosecondsOfVertex = 2000;
  const double nanoseconds = kNanosecondsOfVertex * mesh->vertex_count();
  auto marching = TetFastMarching::build(mesh);
  if (!marching) return marching.error();
  return std::shared_ptr<const DistanceMethod>(std::make_shared<const TetMarchingMethod>(
      std::move(mesh), *std::move(marching), bytes, watch.milliseconds(), threads, nanoseconds));
}

}  // namespace geotherm
