// SPDX-License-Identifier: MIT
#include "solver/polyhedral/wave_method.h"

#include "solver/accuracy/check_waves.h"
#include "solver/core/stopwatch.h"
#include "solver/method/reach.h"

namespace geotherm {

Result<DistanceResult> WaveMethod::State::solve(const SourceSet& sources, const QueryOptions& query,
                                                int at_once, const Progress& progress) const {
  Stopwatch watch;
  const IntrinsicSurface& base = surface->base;
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  if (auto valid = check_reach(query.reach, base.mesh->vertex_count()); !valid) {
    return valid.error();
  }
  const auto seeds = seed_sources(*surface, sources);
  if (!seeds) return seeds.error();
  auto result = answer(*seeds, query, at_once, progress);
  if (!result) return result;
  result->timing.query = watch.lap();
  if (query.reach.is_bounded()) return result;
  if (query.quality) assess_waves(kind(), *surface, sources, *seeds, *result);
  watch.lap();
  const auto own = static_cast<std::size_t>(base.mesh->vertex_count());
  result->distances.resize(own);
  if (query.nearest) result->nearest_source.resize(own);
  for (double& distance : result->distances) distance *= base.length_unit();
  if (query.reach.sparse) keep_reach(query.reach, *result);
  result->timing.query += watch.lap();
  return result;
}

WaveMethod::WaveMethod(std::unique_ptr<const State> state) : state_(std::move(state)) {}
WaveMethod::~WaveMethod() = default;

MethodKind WaveMethod::kind() const { return state_->kind(); }

Result<std::vector<DistanceResult>> WaveMethod::solve_each(std::span<const SourceSet> sets,
                                                           const QueryOptions& query,
                                                           const Progress& progress) const {
  const int at_once = state_->threads.at_once(sets.size());
  return solve_sets(sets, state_->threads, progress,
                    [&](const SourceSet& sources, const Progress& part) {
                      return state_->solve(sources, query, at_once, part);
                    });
}

const SetupTiming& WaveMethod::timing() const { return state_->timing; }
double WaveMethod::memory_mb() const { return state_->bytes() / (1 << 20); }
const std::vector<Warning>& WaveMethod::warnings() const { return state_->surface->base.warnings; }
const std::shared_ptr<const WaveSurface>& WaveMethod::surface() const { return state_->surface; }

DistanceResult answer_within(std::vector<ReachedVertex> reached, Index vertices,
                             const QueryOptions& query) {
  const bool targets = !query.reach.targets.empty();
  const bool dense = !targets && !query.reach.sparse;
  DistanceResult result;
  if (dense) result.distances.assign(static_cast<std::size_t>(vertices), kUnreached);
  if (dense && query.nearest) result.nearest_source.assign(result.distances.size(), kNoIndex);
  if (!dense && !targets) std::ranges::sort(reached, {}, &ReachedVertex::vertex);
  for (auto [vertex, distance, label] : reached) {
    if (!(distance <= query.reach.max_distance && distance < kUnreached)) {
      if (!targets) continue;
      distance = kUnreached;
      label = kNoIndex;
    }
    if (dense) {
      result.distances[vertex] = distance;
      if (query.nearest) result.nearest_source[vertex] = label;
    } else {
      result.vertices.push_back(vertex);
      result.distances.push_back(distance);
      if (query.nearest) result.nearest_source.push_back(label);
    }
  }
  return result;
}

}  // namespace geotherm
