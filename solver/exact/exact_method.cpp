// SPDX-License-Identifier: MIT
#include "solver/exact/exact_method.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/exact/propagation.h"
#include "solver/wave/judge_wave.h"

namespace geotherm {

struct ExactMethod::State {
  State(std::shared_ptr<const WaveSurface> waves, int thread_limit)
      : surface(std::move(waves)), mesh(*surface), threads(thread_limit) {}

  std::shared_ptr<const WaveSurface> surface;
  WindowMesh mesh;
  int threads;
  SetupTiming timing;
};

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

Error out_of_memory(const char* stage, Index faces) {
  return {ErrorCode::kOutOfMemory, "the memory ended in the " + std::string(stage) +
                                       " of exact distances on " + std::to_string(faces) +
                                       " faces; use the method wavefront-fine"};
}

Result<DistanceResult> solve_one(const WaveSurface& surface, const WindowMesh& mesh,
                                 const SourceSet& sources, const QueryOptions& query,
                                 const Progress& progress) try {
  const Stopwatch watch;
  const auto seeds = seed_sources(surface, sources);
  if (!seeds) return seeds.error();
  Propagation windows(mesh);
  if (auto done = windows.run(*seeds, progress); !done) return done.error();

  DistanceResult result;
  result.distances.reserve(windows.vertices().size());
  for (const auto& vertex : windows.vertices()) result.distances.push_back(vertex.distance);
  if (query.quality) judge_wave(surface, *seeds, result);
  for (double& distance : result.distances) distance *= surface.base.mean_edge;
  if (query.nearest) {
    for (const auto& vertex : windows.vertices()) result.nearest_source.push_back(vertex.group);
  }
  result.timing.query = watch.milliseconds();
  return result;
} catch (const std::bad_alloc&) {
  return out_of_memory("query", surface.face_count());
}

}  // namespace

ExactMethod::ExactMethod(std::unique_ptr<const State> state) : state_(std::move(state)) {}
ExactMethod::~ExactMethod() = default;

Result<std::shared_ptr<const ExactMethod>> ExactMethod::build(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress) try {
  const Stopwatch watch;
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  auto state = std::make_unique<State>(std::move(surface), thread_count(threads));
  state->timing.operators = state->timing.setup = watch.milliseconds();
  return std::shared_ptr<const ExactMethod>(new ExactMethod(std::move(state)));
} catch (const std::bad_alloc&) {
  return out_of_memory("set-up", surface ? surface->face_count() : 0);
}

Result<std::vector<DistanceResult>> ExactMethod::solve_each(std::span<const SourceSet> sets,
                                                            const QueryOptions& query,
                                                            const Progress& progress) const try {
  std::vector<std::optional<Result<DistanceResult>>> answers(sets.size());
  SharedProgress shared(progress);
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&](std::int64_t, std::int64_t) {
    for (std::size_t i = next++; i < sets.size(); i = next++) {
      answers[i] = solve_one(*state_->surface, state_->mesh, sets[i], query,
                             [&](std::string_view stage, double share) {
                               const double whole = static_cast<double>(done) + share;
                               return shared(stage, whole / static_cast<double>(sets.size()));
                             });
      ++done;
    }
  };
  parallel_for(state_->threads, static_cast<std::int64_t>(sets.size()), 1, work);

  std::vector<DistanceResult> results;
  results.reserve(sets.size());
  for (auto& answer : answers) {
    if (!*answer) return answer->error();
    results.push_back(std::move(**answer));
  }
  return results;
} catch (const std::bad_alloc&) {
  return out_of_memory("query", state_->surface->face_count());
}

const SetupTiming& ExactMethod::timing() const { return state_->timing; }
double ExactMethod::memory_mb() const { return state_->mesh.bytes() / kMiB; }
const std::vector<std::string>& ExactMethod::warnings() const {
  return state_->surface->base.warnings;
}

}  // namespace geotherm
