// SPDX-License-Identifier: MIT
#include "geotherm/polyhedral_methods.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <new>
#include <queue>
#include <span>
#include <vector>

#include "solver/accuracy/check_waves.h"
#include "solver/core/stopwatch.h"
#include "solver/method/reach.h"
#include "solver/method/solve_sets.h"
#include "solver/polyhedral/march_supports.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

/// What a query takes at least for each face.
constexpr double kMarchNanosecondsPerFace = 100;

/// A ray may miss the support by this share of its base.
constexpr double kRayTolerance = 1e-12;
/// Accepted vertices between two calls of progress: a few milliseconds.
constexpr Index kVerticesBetweenCalls = 1 << 13;

/// How far a march goes.
struct MarchReach {
  double radius = kUnreached;        ///< in units of the intrinsic mesh
  std::span<const Index> targets{};  ///< ends when these have their distance; empty: never
};

/// Marches from sources, one after another; values in units of the intrinsic mesh, above `base`.
class March {
 public:
  March(const WaveSurface& surface, const MarchSupports& supports)
      : surface_(surface),
        supports_(supports),
        distance(surface.base.kept->on_surface.size(), kUnreached),
        label(distance.size(), kNoIndex),
        accepted_(distance.size(), 0) {}

  /// False when `progress` returned false.
  bool run(const SourceSeeds& seeds, const MarchReach& reach, const Progress& progress) {
    clear();
    seed(seeds);
    Index count = 0;
    std::size_t has = 0;
    while (!heap_.empty()) {
      const auto [key, vertex] = heap_.top();
      if (base + key > reach.radius) break;
      while (has < reach.targets.size() && accepted_[reach.targets[has]]) ++has;
      if (has == reach.targets.size() && has > 0) break;
      heap_.pop();
      if (accepted_[vertex]) continue;  // accepted before, with a smaller value
      accepted_[vertex] = 1;
      for (const Index s : supports_.of(vertex)) update(supports_.all[s], vertex);
      if (++count % kVerticesBetweenCalls != 0) continue;
      const double share = static_cast<double>(count) / static_cast<double>(distance.size());
      if (!report(progress, "solve", share)) return false;
    }
    return true;
  }

  /// The vertices that have a value; those that are not accepted may have a smaller one.
  std::span<const Index> touched() const { return touched_; }
  bool is_accepted(Index vertex) const { return accepted_[vertex] != 0; }

 private:
  /// Forgets the march before. Cost: that of what it touched.
  void clear() {
    for (const Index v : touched_) {
      distance[v] = kUnreached;
      label[v] = kNoIndex;
      accepted_[v] = 0;
    }
    touched_.clear();
    heap_ = {};
  }

  void seed(const SourceSeeds& seeds) {
    base = least_offset(seeds);
    for (const auto& vertex : seeds.vertices) {
      lower(vertex.vertex, vertex.offset - base, vertex.group);
    }
    for (const auto& piece : seeds.pieces) {
      const auto at = corners_of(lay_out(surface_.base.intrinsic.lengths[piece.face]));
      for (int k = 0; k < 3; ++k) {
        lower(surface_.base.intrinsic.faces[piece.face][k],
              piece.offset - base + distance_to(piece, at[k]), piece.group);
      }
    }
  }

  /// Updates the target along the side from `from`, and by a plane wave where the other end is
  /// known, too.
  void update(const MarchSupport& s, Index from) {
    if (accepted_[s.target]) return;
    const double left = distance[s.left], right = distance[s.right];
    if (s.left == from) lower(s.target, left + std::hypot(s.x, s.y), label[s.left]);
    if (s.right == from) lower(s.target, right + std::hypot(s.x - s.base, s.y), label[s.right]);
    if (!accepted_[s.left] || !accepted_[s.right]) return;
    const double ux = (right - left) / s.base;
    const double across = 1 - ux * ux;
    if (!(across > 0)) return;
    const double uy = std::sqrt(across);
    const double crossing = s.x - s.y * ux / uy;  // where the ray to the target leaves the base
    if (!(crossing >= -kRayTolerance * s.base && crossing <= (1 + kRayTolerance) * s.base)) return;
    lower(s.target, left + ux * s.x + uy * s.y, label[2 * crossing < s.base ? s.left : s.right]);
  }

  void lower(Index vertex, double candidate, Index group) {
    if (!(candidate < distance[vertex])) return;
    if (distance[vertex] == kUnreached) touched_.push_back(vertex);
    distance[vertex] = candidate;
    label[vertex] = group;
    heap_.emplace(candidate, vertex);
  }

  const WaveSurface& surface_;
  const MarchSupports& supports_;

 public:
  std::vector<double> distance;
  std::vector<Index> label;
  double base = 0;

 private:
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
  std::vector<char> accepted_;
  std::vector<Index> touched_;
};

/// Marches that are kept between queries that do not go far: a new one clears all of its memory.
class MarchPool {
 public:
  std::unique_ptr<March> take(const WaveSurface& surface, const MarchSupports& supports) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<March>(surface, supports);
    auto march = std::move(free_.back());
    free_.pop_back();
    return march;
  }
  void give(std::unique_ptr<March> march) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(march));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<March>> free_;
};

/// What is within reach, in model units.
DistanceResult reached_by(const March& march, const WaveSurface& surface,
                          const QueryOptions& query) {
  const Reach& reach = query.reach;
  DistanceResult result;
  std::vector<Index> from;
  if (!reach.targets.empty()) {
    result.vertices = from = reach.targets;
  } else {
    from.assign(march.touched().begin(), march.touched().end());
    if (reach.sparse) std::ranges::sort(from);
  }
  const bool dense = reach.targets.empty() && !reach.sparse;
  if (dense) result.distances.assign(march.distance.size(), kUnreached);
  if (dense && query.nearest) result.nearest_source.assign(march.distance.size(), kNoIndex);
  for (const Index v : from) {
    const double d = (march.distance[v] + march.base) * surface.base.length_unit();
    const bool within = march.is_accepted(v) && d <= reach.max_distance;
    if (dense) {
      if (!within) continue;
      result.distances[v] = d;
      if (query.nearest) result.nearest_source[v] = march.label[v];
    } else if (within || !reach.targets.empty()) {
      if (reach.targets.empty()) result.vertices.push_back(v);
      result.distances.push_back(within ? d : kUnreached);
      if (query.nearest) result.nearest_source.push_back(within ? march.label[v] : kNoIndex);
    }
  }
  return result;
}

Result<DistanceResult> solve_near(const WaveSurface& surface, const MarchSupports& supports,
                                  MarchPool& pool, const SourceSeeds& seeds,
                                  const QueryOptions& query, const Progress& progress) {
  constexpr double kMore = 1 + 1e-12;  // rounding must not leave out what is at just this distance
  const Stopwatch watch;
  const double radius = query.reach.max_distance * kMore / surface.base.length_unit();
  auto march = pool.take(surface, supports);
  const bool done = march->run(seeds, {radius, query.reach.targets}, progress);
  DistanceResult result;
  if (done) result = reached_by(*march, surface, query);
  pool.give(std::move(march));
  if (!done) return cancelled_error();
  result.timing.query = watch.milliseconds();
  return result;
}

Result<DistanceResult> solve_one(const WaveSurface& surface, const MarchSupports& supports,
                                 MarchPool& pool, const SourceSet& sources,
                                 const QueryOptions& query, const Progress& progress) {
  Stopwatch watch;
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  if (auto valid = check_reach(query.reach, surface.base.mesh->vertex_count()); !valid) {
    return valid.error();
  }
  const auto seeds = seed_sources(surface, sources);
  if (!seeds) return seeds.error();
  if (query.reach.is_bounded()) return solve_near(surface, supports, pool, *seeds, query, progress);
  March march(surface, supports);
  if (!march.run(*seeds, {}, progress)) return cancelled_error();
  DistanceResult result;
  result.distances = std::move(march.distance);
  for (double& distance : result.distances) distance += march.base;
  if (query.nearest) result.nearest_source = std::move(march.label);
  result.timing.query = watch.lap();
  if (query.quality) assess_waves(MethodKind::kFastMarching, surface, sources, *seeds, result);
  watch.lap();
  for (double& distance : result.distances) distance *= surface.base.length_unit();
  if (query.reach.sparse) keep_reach(query.reach, result);
  result.timing.query += watch.lap();
  return result;
}

}  // namespace

struct FastMarchingMethod::State {
  std::shared_ptr<const WaveSurface> surface;
  MarchSupports supports;
  mutable MarchPool pool;
  SetThreads threads;
  SetupTiming timing;
};

FastMarchingMethod::FastMarchingMethod(std::unique_ptr<const State> state)
    : state_(std::move(state)) {}
FastMarchingMethod::~FastMarchingMethod() = default;

Result<std::shared_ptr<const FastMarchingMethod>> FastMarchingMethod::build(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress) {
  const Stopwatch watch;
  const Index faces = surface->face_count();
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  try {
    auto state = std::make_unique<State>();
    state->surface = std::move(surface);
    state->threads.most = threads;
    state->threads.nanoseconds = kMarchNanosecondsPerFace * faces;
    state->supports = build_march_supports(*state->surface);
    if (!report(progress, "operators", 1.0)) return cancelled_error();
    state->timing.operators = state->timing.setup = watch.milliseconds();
    return std::shared_ptr<const FastMarchingMethod>(new FastMarchingMethod(std::move(state)));
  } catch (const std::bad_alloc&) {
    return wave_out_of_memory("tables", faces);
  }
}

Result<std::vector<DistanceResult>> FastMarchingMethod::solve_each(std::span<const SourceSet> sets,
                                                                   const QueryOptions& query,
                                                                   const Progress& progress) const {
  return solve_sets(
      sets, state_->threads, progress, [&](const SourceSet& sources, const Progress& part) {
        return solve_one(*state_->surface, state_->supports, state_->pool, sources, query, part);
      });
}

const SetupTiming& FastMarchingMethod::timing() const { return state_->timing; }

double FastMarchingMethod::memory_mb() const {
  return static_cast<double>(state_->supports.bytes()) / (1024.0 * 1024.0);
}

const std::shared_ptr<const WaveSurface>& FastMarchingMethod::surface() const {
  return state_->surface;
}

const std::vector<Warning>& FastMarchingMethod::warnings() const {
  return state_->surface->base.warnings;
}

}  // namespace geotherm
