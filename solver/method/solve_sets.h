// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "solver/method/distance_method.h"

namespace geotherm {

/// Solves one source set; on any thread, several at once.
using SolveSet = std::function<Result<DistanceResult>(const SourceSet&, const Progress&)>;

/// How many sets of `sets` are solved at once on `threads` threads (0: all cores); at least 1.
int solving_at_once(int threads, std::size_t sets);

/// Calls `solve` for every set, shared out over `threads` threads (0: all cores; fewer where the
/// system has no more). The first failure ends the work; one set after another fails in their
/// order. `progress` is called by one thread at a time, with shares that do not fall. Timings are
/// shares of the wall clock. std::bad_alloc becomes kOutOfMemory.
Result<std::vector<DistanceResult>> solve_sets(std::span<const SourceSet> sets, int threads,
                                               const Progress& progress, const SolveSet& solve);

}  // namespace geotherm
