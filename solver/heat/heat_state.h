// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "geotherm/heat_method.h"
#include "solver/core/threads.h"
#include "solver/heat/domain.h"
#include "solver/heat/heat_step.h"
#include "solver/heat/linear_system.h"
#include "solver/heat/poisson.h"
#include "solver/linear/backend_registry.h"

namespace geotherm {

/// What a query needs of a HeatMethod.
struct QueryPipeline {
  const Domain& domain;
  const HeatStep& heat;
  const PoissonSolver& poisson;
  const HeatOptions& options;
  const DiffusionTimes& times;
  BlockPool& pool;
  HelperPool& helpers;
};

/// Solves every source set, in blocks of up to kSetsInBlock that threads share out: a block streams
/// each factor once. Where there are fewer blocks than threads, the steps of each share theirs. No
/// more threads work than there is work for, few faces have one. The cut into blocks does not
/// depend on the number of threads, nor do the results. `progress` is called by one thread at a
/// time, with shares that do not fall. A query that makes a factor of its own is held against the
/// memory limit before; threads that would have one more each are fewer then. Throws
/// std::bad_alloc.
Attempt<std::vector<DistanceResult>> run_queries(const QueryPipeline& pipeline,
                                                 std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress);

/// What a HeatMethod is made of: for its own two files, heat_method.cpp and heat_fallback.cpp.
struct HeatMethod::State {
  /// Methods that answer where this one fails, by their backends, and why there is none.
  struct Substitutes {
    std::mutex mutex;
    std::map<std::string, Attempt<HeatMethod>> methods;
  };

  HeatOptions options;  ///< with the backend at work
  const Backend* backend = nullptr;
  std::shared_ptr<const Domain> domain;
  std::shared_ptr<const HeatStep> heat;
  std::shared_ptr<const PoissonSolver> poisson;
  std::shared_ptr<BlockPool> pool = std::make_shared<BlockPool>();
  std::shared_ptr<HelperPool> helpers = std::make_shared<HelperPool>();
  std::shared_ptr<Substitutes> substitutes = std::make_shared<Substitutes>();
  DiffusionTimes times;
  SetupTiming timing;
  std::vector<Warning> warnings;
  std::vector<Fallback> failed;  ///< before the backend at work

  /// Everything; by another backend where one fails. `earlier`: of the same space before it moved.
  static Result<HeatMethod> build(const std::shared_ptr<const Domain::Input>& input,
                                  const HeatOptions& options, const Progress& progress,
                                  const State* earlier = nullptr);

  /// Everything with one backend, `options.backend`.
  static Attempt<HeatMethod> set_up(const std::shared_ptr<const Domain::Input>& input,
                                    const HeatOptions& options, std::span<const Fallback> failed,
                                    const Progress& progress, const State* earlier = nullptr);

  /// What is still missing for these options, on the domain and with the backend of `from`.
  static Attempt<HeatMethod> factorised(const State& from, const HeatOptions& options,
                                        std::span<const Fallback> failed, const Progress& progress,
                                        const State* earlier = nullptr);

  Attempt<std::vector<DistanceResult>> ask(std::span<const SourceSet> sets,
                                           const QueryOptions& query,
                                           const Progress& progress) const;

  /// The method that answers with another backend. Waits for a thread that sets the same one up.
  Attempt<HeatMethod> substitute(const std::string& name, std::span<const Fallback> before,
                                 const Progress& progress) const;

  /// The rule at work: that of the options, or the domain's own.
  BoundaryRule boundary() const {
    return options.boundary == BoundaryRule::kAuto ? domain->auto_boundary : options.boundary;
  }

  /// The backend that was asked for.
  const std::string& asked() const {
    return failed.empty() ? options.backend : failed.front().backend;
  }
};

/// The name in the options, or that of the default backend.
std::string backend_name(const HeatOptions& options);

/// Threads that are worth having for the set-up of so many cells.
int setup_threads(const HeatOptions& options, const Domain::Input& input);

/// Checks what can be checked without a domain. Error kBadInput.
Result<void> check_options(const HeatOptions& options);

/// The error that is returned for std::bad_alloc, which no function of the library lets out.
Error out_of_memory_error(const std::string& stage, const Domain::Input& input,
                          const std::string& backend);

}  // namespace geotherm
