// SPDX-License-Identifier: MIT
#include "solver/volume/tet_marching_method.h"

#include <algorithm>
#include <cmath>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/method/marching_method.h"
#include "solver/volume/clean_tets.h"
#include "solver/volume/fast_marching_tets.h"

namespace geotherm {
namespace {

/// The sources as points of the volume. Errors: what only triangle meshes have.
Result<std::vector<VolumePoint>> volume_points(const SourceSet& sources) {
  if (auto valid = check_space_sources(sources, "vertices or points of tets"); !valid) {
    return valid.error();
  }
  std::vector<VolumePoint> out;
  for (const SurfacePoint& point : sources.points) {
    out.push_back(VolumePoint::at_vertex(point.vertex));
  }
  for (const CellPoint& point : sources.cell_points) {
    auto valid = check_weights(point.weights, 4, "tet " + std::to_string(point.cell));
    if (!valid) return valid.error();
    VolumePoint& to = out.emplace_back();
    to.tet = point.cell;
    std::ranges::copy(point.weights, to.weights.begin());
  }
  return out;
}

class TetMarchingMethod final : public MarchingMethod {
 public:
  TetMarchingMethod(std::shared_ptr<const TetMesh> mesh, TetFastMarching marching,
                    std::int64_t bytes, double setup_ms, int threads, double nanoseconds)
      : MarchingMethod(mesh->vertex_count(), static_cast<double>(bytes) / (1 << 20), setup_ms,
                       threads, nanoseconds),
        mesh_(std::move(mesh)),
        marching_(std::move(marching)) {
    for (const std::string& note : marching_.notes()) warnings_.push_back({note});
  }

 private:
  Result<Marched> march(const SourceSet& sources, const Progress& progress) const override {
    const auto points = volume_points(sources);
    if (!points) return points.error();
    // Offsets stand for the points of SourceSet::points; points of cells have none.
    std::vector<double> offsets = sources.offsets;
    if (!offsets.empty()) offsets.resize(points->size(), 0.0);
    auto solved = marching_.solve(*points, offsets, {}, progress);
    if (!solved) return solved.error();
    return Marched{std::move(solved->distances), std::move(solved->nearest)};
  }

  double eikonal_error(std::span<const double> distances) const override {
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
};

}  // namespace

Result<std::shared_ptr<const DistanceMethod>> build_tet_marching(
    std::shared_ptr<const TetMesh> mesh, int threads, const Progress& progress) {
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  const Stopwatch watch;
  constexpr std::int64_t kBytesOfTet = 35;
  const std::int64_t bytes = kBytesOfTet * mesh->tet_count();
  constexpr double kNanosecondsOfVertex = 2000;
  auto marching = TetFastMarching::build(mesh);
  if (!marching) return marching.error();
  return std::shared_ptr<const DistanceMethod>(std::make_shared<const TetMarchingMethod>(
      std::move(mesh), *std::move(marching), bytes, watch.milliseconds(), threads,
      kNanosecondsOfVertex));
}

}  // namespace geotherm
