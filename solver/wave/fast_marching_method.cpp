// SPDX-License-Identifier: MIT
#include "geotherm/polyhedral_methods.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <queue>

#include "solver/accuracy/check_waves.h"
#include "solver/core/stopwatch.h"
#include "solver/method/solve_sets.h"
#include "solver/wave/march_supports.h"
#include "solver/wave/segment_distance.h"

namespace geotherm {
namespace {

/// What a query takes at least for each face.
constexpr double kFaceNanoseconds = 100;

/// A ray that misses the support by no more than this share of its base goes through.
constexpr double kRayTolerance = 1e-12;
/// Accepted vertices between two calls of progress: a few milliseconds.
constexpr Index kVerticesBetweenCalls = 1 << 13;

/// One march from sources to everywhere; values in units of the intrinsic mesh, above `base`.
class March {
 public:
  March(const WaveSurface& surface, const MarchSupports& supports)
      : surface_(surface),
        supports_(supports),
        distance(surface.base.on_surface.size(), kUnreached),
        label(distance.size(), kNoIndex),
        accepted_(distance.size(), 0) {}

  /// False when `progress` said stop.
  bool run(const SourceSeeds& seeds, const Progress& progress) {
    seed(seeds);
    Index count = 0;
    while (!heap_.empty()) {
      const auto [key, vertex] = heap_.top();
      heap_.pop();
      if (accepted_[vertex]) continue;  // it was here with a smaller value
      accepted_[vertex] = 1;
      for (const Index s : supports_.of(vertex)) update(supports_.all[s], vertex);
      if (++count % kVerticesBetweenCalls != 0) continue;
      const double share = static_cast<double>(count) / static_cast<double>(distance.size());
      if (!report(progress, "solve", share)) return false;
    }
    return true;
  }

 private:
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

  /// Along the side from `from`, and as a plane wave where the other end is known, too.
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
};

Result<DistanceResult> solve_one(const WaveSurface& surface, const MarchSupports& supports,
                                 const SourceSet& sources, const QueryOptions& query,
                                 const Progress& progress) {
  Stopwatch watch;
  if (!report(progress, "solve", 0.0)) return cancelled_error();
  const auto seeds = seed_sources(surface, sources);
  if (!seeds) return seeds.error();
  March march(surface, supports);
  if (!march.run(*seeds, progress)) return cancelled_error();
  DistanceResult result;
  result.distances = std::move(march.distance);
  for (double& distance : result.distances) distance += march.base;
  if (query.nearest) result.nearest_source = std::move(march.label);
  result.timing.query = watch.lap();
  if (query.quality) assess_waves(MethodKind::kFastMarching, surface, sources, *seeds, result);
  watch.lap();
  for (double& distance : result.distances) distance *= surface.base.mean_edge;
  result.timing.query += watch.lap();
  return result;
}

}  // namespace

struct FastMarchingMethod::State {
  std::shared_ptr<const WaveSurface> surface;
  MarchSupports supports;
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
    state->threads.nanoseconds = kFaceNanoseconds * faces;
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
  return solve_sets(sets, state_->threads, progress,
                    [&](const SourceSet& sources, const Progress& part) {
                      return solve_one(*state_->surface, state_->supports, sources, query, part);
                    });
}

const SetupTiming& FastMarchingMethod::timing() const { return state_->timing; }

double FastMarchingMethod::memory_mb() const {
  return static_cast<double>(state_->supports.bytes()) / (1024.0 * 1024.0);
}

const std::vector<Warning>& FastMarchingMethod::warnings() const {
  return state_->surface->base.warnings;
}

}  // namespace geotherm
