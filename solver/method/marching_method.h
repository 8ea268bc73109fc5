// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/types.h"
#include "solver/core/stopwatch.h"
#include "solver/method/reach.h"
#include "solver/method/solve_sets.h"

// What methods in volumes and on grids have in common: their sources, and fast marching there.
namespace geotherm {

/// How many have a distance.
inline Index count_reached(std::span<const double> distances) {
  return static_cast<Index>(
      std::ranges::count_if(distances, [](double distance) { return distance < kUnreached; }));
}

/// Whether there are sources, and none that only triangle meshes have. `instead`: "samples or
/// points of cells". Errors: kBadInput.
inline Result<void> check_space_sources(const SourceSet& sources, const std::string& instead) {
  if (sources.empty()) return Error{ErrorCode::kBadInput, "there is no source"};
  if (!sources.edges.empty()) {
    return Error{ErrorCode::kBadInput, "curves of mesh edges are sources of triangle meshes alone"};
  }
  if (!sources.segments.empty()) {
    return Error{ErrorCode::kBadInput, "curves across faces are sources of triangle meshes alone"};
  }
  const auto in_face = [](const SurfacePoint& point) { return !point.is_vertex(); };
  if (std::ranges::none_of(sources.points, in_face)) return {};
  return Error{ErrorCode::kBadInput,
               "points in faces are sources of triangle meshes alone; give " + instead};
}

/// Fast marching in a space that is no triangle mesh.
class MarchingMethod : public DistanceMethod {
 public:
  MethodKind kind() const override { return MethodKind::kFastMarching; }

  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress) const override {
    const auto one = [&](const SourceSet& sources, const Progress& part) -> Result<DistanceResult> {
      const Stopwatch watch;
      auto marched = march(sources, part);
      if (!marched) return marched.error();
      DistanceResult result;
      result.distances = std::move(marched->distances);
      if (query.nearest) result.nearest_source = std::move(marched->nearest);
      result.quality.reached_vertices = count_reached(result.distances);
      result.timing.query = watch.milliseconds();
      if (query.quality) result.quality.eikonal_error_mean = eikonal_error(result.distances);
      const auto vertices = static_cast<Index>(result.distances.size());
      if (auto valid = check_reach(query.reach, vertices); !valid) return valid.error();
      keep_reach(query.reach, result);
      return result;
    };
    return solve_sets(sets, threads_, progress, one);
  }

  const SetupTiming& timing() const override { return timing_; }
  double memory_mb() const override { return memory_mb_; }
  const std::vector<Warning>& warnings() const override { return warnings_; }

 protected:
  struct Marched {
    std::vector<double> distances;
    std::vector<Index> nearest;
  };

  /// `nanoseconds`: that a query takes at least.
  MarchingMethod(double memory_mb, double setup_ms, int threads, double nanoseconds)
      : memory_mb_(memory_mb), threads_{threads, nanoseconds} {
    timing_.operators = timing_.setup = setup_ms;
  }

  /// One query; on several threads at once.
  virtual Result<Marched> march(const SourceSet& sources, const Progress& progress) const = 0;
  /// The mean of | |grad d| - 1 | by measure, over the cells whose corners are all reached.
  virtual double eikonal_error(std::span<const double> distances) const = 0;

  std::vector<Warning> warnings_;

 private:
  double memory_mb_;
  SetThreads threads_;
  SetupTiming timing_;
};

}  // namespace geotherm
