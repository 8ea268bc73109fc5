// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "solver/core/stopwatch.h"
#include "solver/polyhedral/march_supports.h"
#include "solver/polyhedral/wave_method.h"

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

}  // namespace

struct FastMarchingMethod::State final : WaveMethod::State {
  State(std::shared_ptr<const WaveSurface> waves, int thread_limit)
      : WaveMethod::State(std::move(waves), thread_limit, kMarchNanosecondsPerFace),
        supports(build_march_supports(*surface)) {}

  MethodKind kind() const override { return MethodKind::kFastMarching; }
  double bytes() const override { return static_cast<double>(supports.bytes()); }
  Result<DistanceResult> answer(const SourceSeeds& seeds, const QueryOptions& query, int at_once,
                                const Progress& progress) const override;
  Result<DistanceResult> answer_near(const SourceSeeds& seeds, const QueryOptions& query,
                                     const Progress& progress) const;

  MarchSupports supports;
  mutable WorkPool<March> pool;  ///< of queries that do not go far: a new march clears all memory
};

Result<DistanceResult> FastMarchingMethod::State::answer_near(const SourceSeeds& seeds,
                                                              const QueryOptions& query,
                                                              const Progress& progress) const {
  constexpr double kMore = 1 + 1e-12;  // rounding must not leave out what is at just this distance
  const Reach& reach = query.reach;
  const double unit = surface->base.length_unit();
  auto march = pool.take([](const March&) { return true; });
  if (!march) march = std::make_unique<March>(*surface, supports);
  const bool done = march->run(seeds, {reach.max_distance * kMore / unit, reach.targets}, progress);
  std::vector<ReachedVertex> reached;
  for (const Index v : reach.targets.empty() ? march->touched() : std::span(reach.targets)) {
    const double distance = (march->distance[v] + march->base) * unit;
    reached.push_back({v, march->is_accepted(v) ? distance : kUnreached, march->label[v]});
  }
  const auto vertices = static_cast<Index>(march->distance.size());
  pool.give(std::move(march));
  if (!done) return cancelled_error();
  return answer_within(std::move(reached), vertices, query);
}

Result<DistanceResult> FastMarchingMethod::State::answer(const SourceSeeds& seeds,
                                                         const QueryOptions& query, int,
                                                         const Progress& progress) const {
  if (query.reach.is_bounded()) return answer_near(seeds, query, progress);
  March march(*surface, supports);
  if (!march.run(seeds, {}, progress)) return cancelled_error();
  DistanceResult result;
  result.distances = std::move(march.distance);
  for (double& distance : result.distances) distance += march.base;
  if (query.nearest) result.nearest_source = std::move(march.label);
  return result;
}

FastMarchingMethod::FastMarchingMethod(std::unique_ptr<const State> state)
    : WaveMethod(std::move(state)) {}

Result<std::shared_ptr<const FastMarchingMethod>> FastMarchingMethod::build(
    std::shared_ptr<const WaveSurface> surface, int threads, const Progress& progress) try {
  const Stopwatch watch;
  if (!report(progress, "operators", 0.0)) return cancelled_error();
  auto own = without_inserted(surface, threads, progress);
  if (!own) return own.error();
  auto state = std::make_unique<State>(*std::move(own), threads);
  if (!report(progress, "operators", 1.0)) return cancelled_error();
  state->timing.operators = state->timing.setup = watch.milliseconds();
  return std::shared_ptr<const FastMarchingMethod>(new FastMarchingMethod(std::move(state)));
} catch (const std::bad_alloc&) {
  return wave_out_of_memory("tables", surface->face_count());
}

}  // namespace geotherm
