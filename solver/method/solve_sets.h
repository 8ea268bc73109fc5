// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "geotherm/distance_method.h"
#include "solver/core/threads.h"

namespace geotherm {

/// The first job that failed, and why.
struct JobFailure {
  std::size_t job = 0;
  Error error;
};

/// Does one of several jobs; on any thread, several at once.
using Job = std::function<Result<void>(std::size_t job, const Progress&)>;

/// Hands out the jobs 0 to `jobs` - 1 to threads until all are done, one has failed or the work is
/// cancelled. The failure of the first job counts, but for those that the stop itself brought
/// about. `progress` is called by one thread at a time, with shares that do not fall. Throws what
/// it throws, and std::bad_alloc where a job does.
std::optional<JobFailure> share_out_jobs(std::size_t jobs, int threads, HelperPool& helpers,
                                         const Progress& progress, const Job& job);

/// Solves one source set; on any thread, several at once.
using SolveSet = std::function<Result<DistanceResult>(const SourceSet&, const Progress&)>;

/// What a method that solves one set after the other has to share them out.
struct SetThreads {
  int most = 0;            ///< 0: all cores
  double nanoseconds = 0;  ///< that a set takes at least
  mutable HelperPool helpers{};

  /// How many sets of `sets` are solved at once: at least 1, no more than there is work for.
  int at_once(std::size_t sets) const;
};

/// Calls `solve` for every set, shared out over threads (fewer where the system has no more). The
/// first failure ends the work; one set after another fails in their order. `progress` is called by
/// one thread at a time, with shares that do not fall. Timings are shares of the wall clock.
/// std::bad_alloc becomes kOutOfMemory.
Result<std::vector<DistanceResult>> solve_sets(std::span<const SourceSet> sets,
                                               const SetThreads& threads, const Progress& progress,
                                               const SolveSet& solve);

}  // namespace geotherm
