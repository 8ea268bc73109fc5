// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "solver/core/thread_crew.h"
#include "solver/heat/block_pool.h"
#include "solver/heat/component_times.h"
#include "solver/heat/heat_method.h"
#include "solver/heat/heat_step.h"
#include "solver/heat/poisson.h"

namespace geotherm {

/// What a HeatMethod is made of: for its own two files, heat_method.cpp and heat_fallback.cpp.
struct HeatMethod::State {
  /// Methods that answer where this one fails, by their backends, and why there is none.
  struct Substitutes {
    std::mutex mutex;
    std::map<std::string, Attempt<HeatMethod>> methods;
  };

  HeatOptions options;  ///< with the backend at work
  const Backend* backend = nullptr;
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const HeatStep> heat;
  std::shared_ptr<const PoissonSolver> poisson;
  std::shared_ptr<BlockPool> pool = std::make_shared<BlockPool>();
  std::shared_ptr<HelperPool> helpers = std::make_shared<HelperPool>();
  std::shared_ptr<Substitutes> substitutes = std::make_shared<Substitutes>();
  DiffusionTimes times;
  SetupTiming timing;
  std::vector<Warning> warnings;
  std::vector<Fallback> failed;  ///< before the backend at work

  /// The backend that was asked for.
  const std::string& asked() const {
    return failed.empty() ? options.backend : failed.front().backend;
  }
};

/// The name in the options, or that of the default backend.
std::string backend_name(const HeatOptions& options);

/// Threads that are worth having for the set-up of this mesh.
int setup_threads(const HeatOptions& options, const TriangleMesh& mesh);

/// Numbers that no mesh is needed to judge. Error kBadInput.
Result<void> check_options(const HeatOptions& options);

/// For what std::bad_alloc ends: nothing lets it out.
Error out_of_memory_error(const std::string& stage, Index faces, const std::string& backend);

}  // namespace geotherm
