// SPDX-License-Identifier: MIT
#include "geotherm/polyhedral_methods.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "solver/accuracy/check_waves.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/method/reach.h"
#include "solver/method/solve_sets.h"
#include "solver/polyhedral/wave_front.h"

namespace geotherm {
namespace {

/// What a query takes at least for each face.
constexpr double kWaveNanosecondsPerFace = 100;
/// What the tables take for each face.
constexpr double kSetUpNanoseconds = 250;

/// Fronts that are kept between queries: at a million faces the system's clearing of fresh memory
/// takes as long as a tenth of the query. Grows to one for each thread.
class FrontPool {
 public:
  FrontPool(const WaveTables& tables, int samples) : tables_(tables), samples_(samples) {}

  /// `clean`: rather one that needs no clearing than one that does, or the other way round.
  std::unique_ptr<WaveFront> take(bool clean) {
    if (auto front = take_spare(clean)) return front;
    return std::make_unique<WaveFront>(tables_, samples_);
  }
  /// Null where none is free.
  std::unique_ptr<WaveFront> take_spare(bool clean) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return nullptr;
    const auto fits = std::ranges::find(free_, clean, [](const auto& f) { return f->is_clean(); });
    std::swap(fits == free_.end() ? free_.back() : *fits, free_.back());
    auto front = std::move(free_.back());
    free_.pop_back();
    return front;
  }
  void give(std::unique_ptr<WaveFront> front) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(front));
  }

 private:
  const WaveTables& tables_;
  int samples_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<WaveFront>> free_;
};

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

struct WavefrontMethod::State {
  std::shared_ptr<const WaveSurface> surface;
  Samples samples = Samples::kMidpoint;
  SetThreads threads;
  WaveTables tables;
  SetupTiming timing;
  std::unique_ptr<FrontPool> pool;
  std::shared_ptr<SpareWavesPool> spare_waves;  ///< where the surface has moved

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (spare_waves) spare_waves->give({std::move(tables), pool->take_spare(false)});
  }

  MethodKind kind() const {
    return samples == Samples::kMidpoint ? MethodKind::kWavefront : MethodKind::kWavefrontFine;
  }
  int samples_on_edge() const { return samples == Samples::kMidpoint ? 1 : 3; }
  void move_from(const State& before, int workers);
  Result<DistanceResult> solve(const SourceSet& sources, const QueryOptions& query,
                               const Progress& progress) const;
  WaveReach wave_reach(const Reach& reach, std::vector<Index>& ranks) const;
  void copy_out(const WaveFront& front, bool labels, DistanceResult& result) const;
  void copy_reached(WaveFront& front, const QueryOptions& query, DistanceResult& result) const;
};

/// Makes the tables from those of a method with as many samples, whose surface they fit.
void WavefrontMethod::State::move_from(const State& before, int workers) {
  const auto shared = before.spare_waves ? before.spare_waves : std::make_shared<SpareWavesPool>();
  SpareWaves spare = shared->take();
  tables =
      moved_wave_tables(before.tables, *before.surface, *surface, workers, std::move(spare.tables));
  pool = std::make_unique<FrontPool>(tables, samples_on_edge());
  if (spare.front) pool->give(std::make_unique<WaveFront>(tables, std::move(*spare.front)));
  spare_waves = shared;
}

Result<DistanceResult> WavefrontMethod::State::solve(const SourceSet& sources,
                                                     const QueryOptions& query,
                                                     const Progress& progress) const {
  Stopwatch watch;
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  if (auto valid = check_reach(query.reach, surface->base.mesh->vertex_count()); !valid) {
    return valid.error();
  }
  const auto seeds = seed_sources(*surface, sources);
  if (!seeds) return seeds.error();
  DistanceResult result;
  std::vector<Index> ranks;
  const WaveReach reach = wave_reach(query.reach, ranks);
  const bool bounded = query.reach.is_bounded();
  auto front = pool->take(bounded);
  const WaveFront::Outcome outcome = front->run(*surface, *seeds, query.nearest, progress, reach);
  const std::size_t visits = front->visits();
  if (outcome == WaveFront::Outcome::kDone) {
    if (bounded) {
      copy_reached(*front, query, result);
    } else {
      copy_out(*front, query.nearest, result);
    }
  }
  pool->give(std::move(front));
  if (outcome == WaveFront::Outcome::kCancelled) return cancelled_error();
  if (outcome == WaveFront::Outcome::kEndless) {
    return Error{ErrorCode::kBudgetEnded,
                 "waves on " + std::to_string(surface->face_count()) + " faces: no end after " +
                     std::to_string(visits) + " visits of edges",
                 {"use ", SettingHint{"method", {"exact", "heat"}}}};
  }
  result.timing.query = watch.lap();
  if (bounded) return result;
  if (query.quality) assess_waves(kind(), *surface, sources, *seeds, result);
  watch.lap();
  const auto own = static_cast<std::size_t>(surface->base.mesh->vertex_count());
  result.distances.resize(own);
  if (query.nearest) result.nearest_source.resize(own);
  for (double& distance : result.distances) distance *= surface->base.length_unit();
  if (query.reach.sparse) keep_reach(query.reach, result);
  result.timing.query += watch.lap();
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

/// What is within reach, in model units. Cost: that of what was reached, and where the answer is
/// neither sparse nor of targets one pass over the vertices.
void WavefrontMethod::State::copy_reached(WaveFront& front, const QueryOptions& query,
                                          DistanceResult& result) const {
  const Reach& reach = query.reach;
  const double unit = surface->base.length_unit();
  const auto own = surface->base.mesh->vertex_count();
  const std::vector<Index>& targets = reach.targets;
  if (!targets.empty()) {  // before the front lets go of them
    result.vertices = targets;
    for (const Index v : targets) {
      const Index rank = tables.rank_of_vertex[v];
      const double d = rank == kNoIndex ? kUnreached : front.distances()[rank];
      const double there = (std::max(d, 0.0) + front.base()) * unit;
      const bool within = there <= reach.max_distance && there < kUnreached;
      result.distances.push_back(within ? there : kUnreached);
      if (query.nearest) {
        result.nearest_source.push_back(within ? front.labels()[rank] : kNoIndex);
      }
    }
  }
  std::vector<WaveFront::Reached> reached = front.take_reached();
  if (!targets.empty()) return;
  std::erase_if(reached, [&](WaveFront::Reached& each) {
    each.rank = tables.vertex_of_rank[each.rank];
    each.distance = (std::max(each.distance, 0.0) + front.base()) * unit;
    return each.rank >= own || !(each.distance <= reach.max_distance);
  });
  if (reach.sparse) {
    std::ranges::sort(reached, {}, &WaveFront::Reached::rank);
    for (const auto& each : reached) {
      result.vertices.push_back(each.rank);
      result.distances.push_back(each.distance);
      if (query.nearest) result.nearest_source.push_back(each.label);
    }
    return;
  }
  result.distances.assign(static_cast<std::size_t>(own), kUnreached);
  if (query.nearest) result.nearest_source.assign(static_cast<std::size_t>(own), kNoIndex);
  for (const auto& each : reached) {
    result.distances[each.rank] = each.distance;
    if (query.nearest) result.nearest_source[each.rank] = each.label;
  }
}

/// In the order of the file, inserted vertices last, still in units of the intrinsic mesh.
void WavefrontMethod::State::copy_out(const WaveFront& front, bool labels,
                                      DistanceResult& result) const {
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
}

WavefrontMethod::WavefrontMethod(std::unique_ptr<const State> state) : state_(std::move(state)) {}
WavefrontMethod::~WavefrontMethod() = default;

Result<std::shared_ptr<const WavefrontMethod>> WavefrontMethod::build(
    std::shared_ptr<const WaveSurface> surface, Samples samples, int threads,
    const Progress& progress, const WavefrontMethod* earlier) {
  const Stopwatch watch;
  const Index faces = surface->face_count();
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  try {
    auto state = std::make_unique<State>();
    state->surface = std::move(surface);
    state->samples = samples;
    state->threads.most = threads;
    state->threads.nanoseconds = kWaveNanosecondsPerFace * faces;
    const int worth = threads_worth_starting(thread_count(threads), kSetUpNanoseconds * faces);
    const ThreadCrew crew(worth);
    const State* const before = earlier != nullptr ? earlier->state_.get() : nullptr;
    if (before != nullptr && before->samples == samples &&
        can_move_tables(before->surface->base, state->surface->base)) {
      state->move_from(*before, worth);
    } else {
      state->tables = build_wave_tables(*state->surface, worth);
      state->pool = std::make_unique<FrontPool>(state->tables, state->samples_on_edge());
    }
    if (!report(progress, "operators", 1.0)) return cancelled_error();
    state->timing.operators = state->timing.setup = watch.milliseconds();
    return std::shared_ptr<const WavefrontMethod>(new WavefrontMethod(std::move(state)));
  } catch (const std::bad_alloc&) {
    return wave_out_of_memory("tables", faces);
  }
}

MethodKind WavefrontMethod::kind() const { return state_->kind(); }

Result<std::vector<DistanceResult>> WavefrontMethod::solve_each(std::span<const SourceSet> sets,
                                                                const QueryOptions& query,
                                                                const Progress& progress) const {
  return solve_sets(sets, state_->threads, progress,
                    [&](const SourceSet& sources, const Progress& part) {
                      return state_->solve(sources, query, part);
                    });
}

const SetupTiming& WavefrontMethod::timing() const { return state_->timing; }

double WavefrontMethod::memory_mb() const {
  return static_cast<double>(state_->tables.bytes()) / (1024.0 * 1024.0);
}

const std::shared_ptr<const WaveSurface>& WavefrontMethod::surface() const {
  return state_->surface;
}

const std::vector<Warning>& WavefrontMethod::warnings() const {
  return state_->surface->base.warnings;
}

}  // namespace geotherm
