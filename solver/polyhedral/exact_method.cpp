// SPDX-License-Identifier: MIT
#include "geotherm/polyhedral_methods.h"

#include <new>
#include <string>
#include <utility>

#include "solver/accuracy/check_waves.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/method/reach.h"
#include "solver/method/solve_sets.h"
#include "solver/polyhedral/propagation.h"

namespace geotherm {
namespace {

/// What a query takes at least for each face.
constexpr double kWindowNanosecondsPerFace = 1000;

}  // namespace

struct ExactMethod::State {
  State(std::shared_ptr<const WaveSurface> waves, int thread_limit)
      : surface(std::move(waves)),
        mesh(*surface),
        threads{thread_limit, kWindowNanosecondsPerFace * surface->face_count()} {}

  std::shared_ptr<const WaveSurface> surface;
  WindowMesh mesh;
  SetThreads threads;
  SetupTiming timing;

  Result<DistanceResult> solve(const SourceSet& sources, std::size_t most_bytes,
                               const QueryOptions& query, const Progress& progress) const;
};

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

Error out_of_memory(const char* stage, Index faces) {
  return {ErrorCode::kOutOfMemory,
          "the memory ended in the " + std::string(stage) + " of exact distances on " +
              std::to_string(faces) + " faces",
          {"use ", SettingHint{"method", {"wavefront-fine"}}}};
}

}  // namespace

Result<DistanceResult> ExactMethod::State::solve(const SourceSet& sources, std::size_t most_bytes,
                                                 const QueryOptions& query,
                                                 const Progress& progress) const try {
  const Stopwatch watch;
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  const Reach& reach = query.reach;
  if (auto valid = check_reach(reach, surface->base.mesh->vertex_count()); !valid) {
    return valid.error();
  }
  const auto seeds = seed_sources(*surface, sources);
  if (!seeds) return seeds.error();
  Propagation windows(mesh, most_bytes);
  const double radius = reach.max_distance / surface->base.length_unit();
  auto done = windows.run(*seeds, progress, radius, reach.targets);
  if (!done) return done.error();

  DistanceResult result;
  result.distances.reserve(windows.vertices().size());
  for (const auto& vertex : windows.vertices()) result.distances.push_back(vertex.distance);
  if (query.quality && !reach.is_bounded())
    assess_waves(MethodKind::kExact, *surface, sources, *seeds, result);
  for (double& distance : result.distances) distance *= surface->base.length_unit();
  if (query.nearest) {
    for (const auto& vertex : windows.vertices()) result.nearest_source.push_back(vertex.group);
  }
  keep_reach(reach, result);
  result.timing.query = watch.milliseconds();
  return result;
} catch (const std::bad_alloc&) {
  return out_of_memory("query", surface->face_count());
}

ExactMethod::ExactMethod(std::unique_ptr<const State> state) : state_(std::move(state)) {}
ExactMethod::~ExactMethod() = default;

Result<std::shared_ptr<const ExactMethod>> ExactMethod::build(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress) try {
  const Stopwatch watch;
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  auto state = std::make_unique<State>(surface, threads);
  state->timing.operators = state->timing.setup = watch.milliseconds();
  return std::shared_ptr<const ExactMethod>(new ExactMethod(std::move(state)));
} catch (const std::bad_alloc&) {
  return out_of_memory("set-up", surface->face_count());
}

Result<std::vector<DistanceResult>> ExactMethod::solve_each(std::span<const SourceSet> sets,
                                                            const QueryOptions& query,
                                                            const Progress& progress) const {
  const auto workers = static_cast<std::size_t>(state_->threads.at_once(sets.size()));
  return solve_sets(sets, state_->threads, progress,
                    [&](const SourceSet& sources, const Progress& part) {
                      return state_->solve(sources, Propagation::kMaxBytes / workers, query, part);
                    });
}

const SetupTiming& ExactMethod::timing() const { return state_->timing; }
double ExactMethod::memory_mb() const { return state_->mesh.bytes() / kMiB; }
const std::shared_ptr<const WaveSurface>& ExactMethod::surface() const { return state_->surface; }

const std::vector<Warning>& ExactMethod::warnings() const { return state_->surface->base.warnings; }

}  // namespace geotherm
