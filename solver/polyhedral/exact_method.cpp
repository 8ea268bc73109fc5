// SPDX-License-Identifier: MIT
#include <new>
#include <string>
#include <utility>

#include "solver/core/stopwatch.h"
#include "solver/method/reach.h"
#include "solver/polyhedral/propagation.h"
#include "solver/polyhedral/wave_method.h"

namespace geotherm {
namespace {

/// What a query takes at least for each face.
constexpr double kWindowNanosecondsPerFace = 1000;

Error out_of_memory(const char* stage, Index faces) {
  return {ErrorCode::kOutOfMemory,
          "the memory ended in the " + std::string(stage) + " of exact distances on " +
              std::to_string(faces) + " faces",
          {"use ", SettingHint{"method", {"wavefront-fine"}}}};
}

}  // namespace

struct ExactMethod::State final : WaveMethod::State {
  State(std::shared_ptr<const WaveSurface> waves, int thread_limit)
      : WaveMethod::State(std::move(waves), thread_limit, kWindowNanosecondsPerFace),
        mesh(*surface) {}

  MethodKind kind() const override { return MethodKind::kExact; }
  double bytes() const override { return mesh.bytes(); }
  Result<DistanceResult> answer(const SourceSeeds& seeds, const QueryOptions& query, int at_once,
                                const Progress& progress) const override;

  WindowMesh mesh;
};

Result<DistanceResult> ExactMethod::State::answer(const SourceSeeds& seeds,
                                                  const QueryOptions& query, int at_once,
                                                  const Progress& progress) const try {
  const Reach& reach = query.reach;
  const double unit = surface->base.length_unit();
  Propagation windows(mesh, Propagation::kMaxBytes / static_cast<std::size_t>(at_once));
  auto done = windows.run(seeds, progress, reach.max_distance / unit, reach.targets);
  if (!done) return done.error();

  DistanceResult result;
  result.distances.reserve(windows.vertices().size());
  for (const auto& vertex : windows.vertices()) {
    result.distances.push_back(reach.is_bounded() ? vertex.distance * unit : vertex.distance);
    if (query.nearest) result.nearest_source.push_back(vertex.group);
  }
  if (reach.is_bounded()) keep_reach(reach, result);
  return result;
} catch (const std::bad_alloc&) {
  return out_of_memory("query", surface->face_count());
}

ExactMethod::ExactMethod(std::unique_ptr<const State> state) : WaveMethod(std::move(state)) {}

Result<std::shared_ptr<const ExactMethod>> ExactMethod::build(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress) try {
  const Stopwatch watch;
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  auto own = without_inserted(surface, threads, progress);
  if (!own) return own.error();
  auto state = std::make_unique<State>(*std::move(own), threads);
  state->timing.operators = state->timing.setup = watch.milliseconds();
  return std::shared_ptr<const ExactMethod>(new ExactMethod(std::move(state)));
} catch (const std::bad_alloc&) {
  return out_of_memory("set-up", surface->face_count());
}

}  // namespace geotherm
