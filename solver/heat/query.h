// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/core/thread_crew.h"
#include "solver/heat/component_times.h"
#include "solver/heat/heat_method.h"
#include "solver/heat/heat_step.h"
#include "solver/heat/poisson.h"

namespace geotherm {

/// What a query needs of a HeatMethod.
struct QueryPipeline {
  const Surface& surface;
  const HeatStep& heat;
  const PoissonSolver& poisson;
  const HeatOptions& options;
  const DiffusionTimes& times;
  BlockPool& pool;
  HelperPool& helpers;
};

/// Solves every source set, in blocks of up to sixteen that threads share out: a block streams each
/// factor once. Where there are fewer blocks than threads, the steps of each share theirs. No more
/// threads work than there is work for, few faces have one. The cut
/// into blocks does not depend on the number of threads, nor do the results.
/// `progress` is called by one thread at a time, with shares that do not fall.
/// A query that makes a factor of its own is held against the memory limit before; threads that
/// would have one more each are fewer then. Throws std::bad_alloc.
Attempt<std::vector<DistanceResult>> run_queries(const QueryPipeline& pipeline,
                                                 std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress);

}  // namespace geotherm
