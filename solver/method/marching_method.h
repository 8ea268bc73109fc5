// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "geotherm/distance_method.h"
#include "geotherm/types.h"
#include "solver/method/solve_sets.h"

// What methods in volumes and on grids have in common: their sources, and fast marching there.
namespace geotherm {

/// How many have a distance.
inline Index count_reached(std::span<const double> distances) {
  return static_cast<Index>(
      std::ranges::count_if(distances, [](double distance) { return distance < kUnreached; }));
}

/// Whether there are sources, none that only triangle meshes have, and offsets, if any, of all
/// points, not negative and finite. `instead`: "samples or points of cells". Errors: kBadInput.
Result<void> check_space_sources(const SourceSet& sources, const std::string& instead);

/// Whether a point has a weight for each corner of its cell, none below 0, that sum to 1. `cell`:
/// "tet 17". Errors: kBadInput.
Result<void> check_weights(std::span<const double> weights, std::size_t corners,
                           const std::string& cell);

/// The answer of one march.
struct Marched {
  std::vector<double> distances;  ///< kUnreached where none is
  std::vector<Index> nearest;     ///< the source of each; kNoIndex
};

/// Fast marching in a space that is no triangle mesh.
class MarchingMethod : public DistanceMethod {
 public:
  MethodKind kind() const override { return MethodKind::kFastMarching; }
  Result<std::vector<DistanceResult>> solve_each(std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress) const override;
  const SetupTiming& timing() const override { return timing_; }
  double memory_mb() const override { return memory_mb_; }
  const std::vector<Warning>& warnings() const override { return warnings_; }

 protected:
  /// `nanoseconds`: that a query takes at least for each vertex.
  MarchingMethod(Index vertices, double memory_mb, double setup_ms, int threads, double nanoseconds)
      : vertices_(vertices), memory_mb_(memory_mb), threads_{threads, nanoseconds * vertices} {
    timing_.operators = timing_.setup = setup_ms;
  }

  /// One query; on several threads at once.
  virtual Result<Marched> march(const SourceSet& sources, const Progress& progress) const = 0;
  /// The mean of | |grad d| - 1 | by measure, over the cells whose corners are all reached.
  virtual double eikonal_error(std::span<const double> distances) const = 0;

  std::vector<Warning> warnings_;

 private:
  Index vertices_;
  double memory_mb_;
  SetThreads threads_;
  SetupTiming timing_;
};

}  // namespace geotherm
