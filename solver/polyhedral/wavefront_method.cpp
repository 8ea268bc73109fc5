// SPDX-License-Identifier: MIT
#include <algorithm>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/polyhedral/wave_front.h"
#include "solver/polyhedral/wave_method.h"

namespace geotherm {
namespace {

/// What a query takes at least for each face.
constexpr double kWaveNanosecondsPerFace = 100;
/// What the tables take for each face.
constexpr double kSetUpNanoseconds = 250;

/// Memory that a method leaves to the next but one on a surface that moves: fresh memory would have
/// to be cleared by the system, page by page.
struct SpareWaves {
  WaveTables tables;
  std::unique_ptr<WaveFront> front;
};

/// Keeps the spare memory of one method until another takes it. For several threads.
class SpareWavesPool {
 public:
  SpareWaves take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(kept_, {});
  }
  void give(SpareWaves spare) {
    const std::lock_guard lock(mutex_);
    std::swap(kept_, spare);
  }

 private:
  std::mutex mutex_;
  SpareWaves kept_;
};

}  // namespace

struct WavefrontMethod::State final : WaveMethod::State {
  State(std::shared_ptr<const WaveSurface> waves, Samples samples_of_edge, int thread_limit)
      : WaveMethod::State(std::move(waves), thread_limit, kWaveNanosecondsPerFace),
        samples(samples_of_edge) {}
  ~State() override {
    if (spare_waves) spare_waves->give({std::move(tables), take_spare_front(false)});
  }

  MethodKind kind() const override {
    return samples == Samples::kMidpoint ? MethodKind::kWavefront : MethodKind::kWavefrontFine;
  }
  double bytes() const override { return static_cast<double>(tables.bytes()); }
  Result<DistanceResult> answer(const SourceSeeds& seeds, const QueryOptions& query, int at_once,
                                const Progress& progress) const override;
  void move_from(const State& before, int workers);
  /// `clean`: rather one that needs no clearing than one that does, or the other way round. Null
  /// where none is free.
  std::unique_ptr<WaveFront> take_spare_front(bool clean) const {
    return pool.take([clean](const WaveFront& front) { return front.is_clean() == clean; });
  }
  WaveReach wave_reach(const Reach& reach, std::vector<Index>& ranks) const;
  DistanceResult copy_out(const WaveFront& front, bool labels) const;
  DistanceResult copy_reached(WaveFront& front, const QueryOptions& query) const;

  Samples samples;
  WaveTables tables;
  /// At a million faces the system's clearing of fresh memory takes as long as a tenth of the
  /// query.
  mutable WorkPool<WaveFront> pool;
  std::shared_ptr<SpareWavesPool> spare_waves;  ///< where the surface has moved
};

/// Makes the tables from those of a method with as many samples, whose surface they fit.
void WavefrontMethod::State::move_from(const State& before, int workers) {
  const auto shared = before.spare_waves ? before.spare_waves : std::make_shared<SpareWavesPool>();
  SpareWaves spare = shared->take();
  tables =
      moved_wave_tables(before.tables, *before.surface, *surface, workers, std::move(spare.tables));
  if (spare.front) pool.give(std::make_unique<WaveFront>(tables, std::move(*spare.front)));
  spare_waves = shared;
}

Result<DistanceResult> WavefrontMethod::State::answer(const SourceSeeds& seeds,
                                                      const QueryOptions& query, int,
                                                      const Progress& progress) const {
  std::vector<Index> ranks;
  const WaveReach reach = wave_reach(query.reach, ranks);
  const bool bounded = query.reach.is_bounded();
  auto front = take_spare_front(bounded);
  const int on_edge = samples == Samples::kMidpoint ? 1 : 3;
  if (!front) front = std::make_unique<WaveFront>(tables, on_edge);
  const WaveFront::Outcome outcome =
      front->run(*surface, seeds, query.nearest, progress, reach, CurveStart::kWindows);
  const std::size_t visits = front->visits();
  DistanceResult result;
  if (outcome == WaveFront::Outcome::kDone) {
    result = bounded ? copy_reached(*front, query) : copy_out(*front, query.nearest);
  }
  pool.give(std::move(front));
  if (outcome == WaveFront::Outcome::kCancelled) return cancelled_error();
  if (outcome == WaveFront::Outcome::kEndless) {
    return Error{ErrorCode::kBudgetEnded,
                 "waves on " + std::to_string(surface->face_count()) + " faces: no end after " +
                     std::to_string(visits) + " visits of edges",
                 {"use ", SettingHint{"method", {"exact", "heat"}}}};
  }
  return result;
}

/// `ranks`: the memory of the targets' ones.
WaveReach WavefrontMethod::State::wave_reach(const Reach& reach, std::vector<Index>& ranks) const {
  // Rounding must not end a wave before a vertex at just this distance.
  constexpr double kMore = 1 + 1e-12;
  for (const Index v : reach.targets) {
    if (const Index rank = tables.rank_of_vertex[v]; rank != kNoIndex) ranks.push_back(rank);
  }
  return {reach.max_distance * kMore / surface->base.length_unit(), ranks};
}

DistanceResult WavefrontMethod::State::copy_reached(WaveFront& front,
                                                    const QueryOptions& query) const {
  const double unit = surface->base.length_unit();
  const Index own = surface->base.mesh->vertex_count();
  const auto from_start = [&](double d) { return (std::max(d, 0.0) + front.base()) * unit; };
  std::vector<ReachedVertex> reached;
  for (const Index v : query.reach.targets) {  // before the front lets go of them
    const Index rank = tables.rank_of_vertex[v];
    const double d = rank == kNoIndex ? kUnreached : front.distances()[rank];
    const bool labelled = query.nearest && rank != kNoIndex;
    reached.push_back({v, from_start(d), labelled ? front.labels()[rank] : kNoIndex});
  }
  for (const auto& [rank, distance, label] : front.take_reached()) {
    const Index v = tables.vertex_of_rank[rank];
    if (v < own && query.reach.targets.empty()) reached.push_back({v, from_start(distance), label});
  }
  return answer_within(std::move(reached), own, query);
}

/// In the order of the file, inserted vertices last, still in units of the intrinsic mesh.
DistanceResult WavefrontMethod::State::copy_out(const WaveFront& front, bool labels) const {
  DistanceResult result;
  const auto vertices = static_cast<std::size_t>(surface->base.vertex_count());
  const auto distances = front.distances();
  result.distances.assign(vertices, kUnreached);
  if (labels) result.nearest_source.assign(vertices, kNoIndex);
  for (std::size_t rank = 0; rank < distances.size(); ++rank) {
    const Index v = tables.vertex_of_rank[rank];
    // Fitted waves may undercut the sources by rounding.
    result.distances[v] = std::max(distances[rank], 0.0) + front.base();
    if (labels) result.nearest_source[v] = front.labels()[rank];
  }
  return result;
}

WavefrontMethod::WavefrontMethod(std::unique_ptr<const State> state)
    : WaveMethod(std::move(state)) {}

Result<std::shared_ptr<const WavefrontMethod>> WavefrontMethod::build(
    std::shared_ptr<const WaveSurface> surface, Samples samples, int threads,
    const Progress& progress, const WavefrontMethod* earlier) try {
  const Stopwatch watch;
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  auto state = std::make_unique<State>(surface, samples, threads);
  const int worth =
      threads_worth_starting(thread_count(threads), kSetUpNanoseconds * surface->face_count());
  const ThreadCrew crew(worth);
  const auto* const before =
      earlier != nullptr ? static_cast<const State*>(earlier->state_.get()) : nullptr;
  if (before != nullptr && before->samples == samples &&
      can_move_tables(before->surface->base, surface->base)) {
    state->move_from(*before, worth);
  } else {
    state->tables = build_wave_tables(*surface, worth);
  }
  if (!report(progress, "operators", 1.0)) return cancelled_error();
  state->timing.operators = state->timing.setup = watch.milliseconds();
  return std::shared_ptr<const WavefrontMethod>(new WavefrontMethod(std::move(state)));
} catch (const std::bad_alloc&) {
  return wave_out_of_memory("tables", surface->face_count());
}

}  // namespace geotherm
