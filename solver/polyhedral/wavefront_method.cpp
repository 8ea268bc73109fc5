// SPDX-License-Identifier: MIT
#include "geotherm/polyhedral_methods.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <string>

#include "solver/accuracy/check_waves.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
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

  std::unique_ptr<WaveFront> take() {
    if (auto front = take_spare()) return front;
    return std::make_unique<WaveFront>(tables_, samples_);
  }
  /// Null where none is free.
  std::unique_ptr<WaveFront> take_spare() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return nullptr;
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

}  // namespace

struct WavefrontMethod::State {
  std::shared_ptr<const WaveSurface> surface;
  Samples samples = Samples::kMidpoint;
  SetThreads threads;
  WaveTables tables;
  SetupTiming timing;
  std::unique_ptr<FrontPool> pool;

  MethodKind kind() const {
    return samples == Samples::kMidpoint ? MethodKind::kWavefront : MethodKind::kWavefrontFine;
  }
  Result<DistanceResult> solve(const SourceSet& sources, const QueryOptions& query,
                               const Progress& progress) const;
  void copy_out(const WaveFront& front, bool labels, DistanceResult& result) const;
};

Result<DistanceResult> WavefrontMethod::State::solve(const SourceSet& sources,
                                                     const QueryOptions& query,
                                                     const Progress& progress) const {
  Stopwatch watch;
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  const auto seeds = seed_sources(*surface, sources);
  if (!seeds) return seeds.error();
  DistanceResult result;
  auto front = pool->take();
  const WaveFront::Outcome outcome = front->run(*surface, *seeds, query.nearest, progress);
  const std::size_t visits = front->visits();
  if (outcome == WaveFront::Outcome::kDone) copy_out(*front, query.nearest, result);
  pool->give(std::move(front));
  if (outcome == WaveFront::Outcome::kCancelled) return cancelled_error();
  if (outcome == WaveFront::Outcome::kEndless) {
    return Error{ErrorCode::kBudgetEnded,
                 "waves on " + std::to_string(surface->face_count()) + " faces: no end after " +
                     std::to_string(visits) + " visits of edges",
                 {"use ", SettingHint{"method", {"exact", "heat"}}}};
  }
  result.timing.query = watch.lap();
  if (query.quality) assess_waves(kind(), *surface, sources, *seeds, result);
  watch.lap();
  const auto own = static_cast<std::size_t>(surface->base.mesh->vertex_count());
  result.distances.resize(own);
  if (query.nearest) result.nearest_source.resize(own);
  for (double& distance : result.distances) distance *= surface->base.length_unit();
  result.timing.query += watch.lap();
  return result;
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
    const bool same_tables = before != nullptr && before->surface->edges == state->surface->edges;
    state->tables = same_tables ? moved_wave_tables(before->tables, *state->surface, worth)
                                : build_wave_tables(*state->surface, worth);
    state->pool = std::make_unique<FrontPool>(state->tables, samples == Samples::kMidpoint ? 1 : 3);
    if (same_tables && before->samples == samples) {
      if (auto spare = before->pool->take_spare()) {
        state->pool->give(std::make_unique<WaveFront>(state->tables, std::move(*spare)));
      }
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
