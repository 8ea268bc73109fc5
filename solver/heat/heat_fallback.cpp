// SPDX-License-Identifier: MIT
// HeatMethod as its users call it: build(), with(), solve_each(), each with the next backend where
// one fails.
#include <chrono>
#include <new>
#include <thread>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/heat/cell_domain.h"
#include "solver/heat/grid_domain.h"
#include "solver/heat/heat_state.h"
#include "solver/heat/surface.h"
#include "solver/method/reach.h"

namespace geotherm {
namespace {

HeatOptions with_backend(HeatOptions options, const std::string& backend) {
  options.backend = backend;
  return options;
}

Error does_not_move() {
  return {ErrorCode::kBadInput, "only triangle meshes move; this method is on another space"};
}

}  // namespace

Result<HeatMethod> HeatMethod::build(std::shared_ptr<const TriangleMesh> mesh,
                                     const HeatOptions& options, const Progress& progress,
                                     const TriangulationReady& ready) {
  return State::build(surface_input(std::move(mesh), {}, ready), options, progress);
}

Result<HeatMethod> HeatMethod::build(std::shared_ptr<const CellComplex> cells,
                                     const HeatOptions& options, const Progress& progress) {
  return State::build(cell_input(std::move(cells)), options, progress);
}

Result<HeatMethod> HeatMethod::build(std::shared_ptr<const Grid> grid, const HeatOptions& options,
                                     const Progress& progress) try {
  auto input = grid_input(std::move(grid));
  if (!input) return input.error();
  return State::build(*input, options, progress);
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, "the memory ended while cells were made of a grid"};
}

Result<HeatMethod> HeatMethod::State::build(const std::shared_ptr<const Domain::Input>& input,
                                            const HeatOptions& options, const Progress& progress,
                                            const State* earlier) try {
  const std::string asked = backend_name(options);
  if (const auto known = find_backend(asked); !known) return known.error();
  if (const auto valid = check_options(options); !valid) return valid.error();
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  const Stopwatch watch;
  std::vector<Fallback> failed;
  const ThreadCrew crew(setup_threads(options, *input));
  auto method = first_that_works<HeatMethod>(
      asked, options.strict, failed,
      [&](const std::string& backend, std::span<const Fallback> before) {
        return set_up(input, with_backend(options, backend), before, watched, earlier);
      });
  shared.rethrow();
  if (!method) return method;
  auto timed = std::make_shared<State>(*method->state_);
  timed->timing.setup = watch.milliseconds();
  return HeatMethod(std::move(timed));
} catch (const std::bad_alloc&) {
  return out_of_memory_error("set-up", *input, backend_name(options));
}

Result<HeatMethod> HeatMethod::with_positions(std::vector<Vec3> positions,
                                              const Progress& progress) const {
  const Surface* const surface = state_->domain->surface();
  if (surface == nullptr) return does_not_move();
  auto moved = surface->mesh->moved(std::move(positions));
  if (!moved) return moved.error();
  return with_mesh(std::make_shared<const TriangleMesh>(*std::move(moved)),
                   with_backend(state_->options, state_->asked()), progress);
}

Result<HeatMethod> HeatMethod::with_mesh(std::shared_ptr<const TriangleMesh> moved,
                                         const HeatOptions& options,
                                         const Progress& progress) const {
  const Surface* const surface = state_->domain->surface();
  if (surface == nullptr) return does_not_move();
  if (auto same = check_moved(*surface->mesh, *moved); !same) return same.error();
  return State::build(
      surface_input(std::move(moved), std::shared_ptr<const Surface>(state_->domain, surface)),
      options, progress, state_.get());
}

Result<HeatMethod> HeatMethod::with(const HeatOptions& options, const Progress& progress) const
    try {
  if (const auto valid = check_options(options); !valid) return valid.error();
  const std::string asked = backend_name(options);
  const std::string& at_work = state_->options.backend;
  const bool taken_over = asked == state_->asked() && !options.strict &&
                          options.memory_limit_mb == state_->options.memory_limit_mb;
  if (options.laplacian != state_->options.laplacian || (asked != at_work && !taken_over)) {
    return State::build(state_->domain->input, options, progress);
  }
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  std::vector<Fallback> failed;
  if (asked != at_work) failed = state_->failed;
  const ThreadCrew crew(setup_threads(options, *state_->domain->input), state_->helpers.get());
  auto method = first_that_works<HeatMethod>(
      at_work, options.strict, failed,
      [&](const std::string& backend, std::span<const Fallback> before) {
        const HeatOptions tried = with_backend(options, backend);
        return backend == at_work ? State::factorised(*state_, tried, before, watched)
                                  : State::set_up(state_->domain->input, tried, before, watched);
      });
  shared.rethrow();
  return method;
} catch (const std::bad_alloc&) {
  return out_of_memory_error("factorisation", *state_->domain->input, backend_name(options));
}

Attempt<HeatMethod> HeatMethod::State::substitute(const std::string& name,
                                                  std::span<const Fallback> before,
                                                  const Progress& progress) const {
  constexpr std::chrono::milliseconds kBetweenLooks(2);
  std::unique_lock lock(substitutes->mutex, std::defer_lock);
  while (!lock.try_lock()) {
    if (!report(progress, "analyze", 0.0)) return {cancelled_error()};
    std::this_thread::sleep_for(kBetweenLooks);
  }
  auto& methods = substitutes->methods;
  if (const auto known = methods.find(name); known != methods.end()) return known->second;
  Attempt<HeatMethod> made = set_up(domain->input, with_backend(options, name), before, progress);
  const bool cancelled = !made.outcome && made.outcome.error().code == ErrorCode::kCancelled;
  if (!cancelled) methods.emplace(name, made);
  return made;
}

Result<std::vector<DistanceResult>> HeatMethod::solve_each(std::span<const SourceSet> sets,
                                                           const QueryOptions& query,
                                                           const Progress& progress) const try {
  using Results = std::vector<DistanceResult>;
  if (auto valid = check_reach(query.reach, state_->domain->input_vertices); !valid) {
    return valid.error();
  }
  const std::string& at_work = state_->options.backend;
  std::string backend = at_work;
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  std::vector<Fallback> failed = state_->failed;
  auto results = first_that_works<Results>(
      at_work, state_->options.strict, failed,
      [&](const std::string& tried, std::span<const Fallback> before) -> Attempt<Results> {
        backend = tried;
        if (tried == at_work) return state_->ask(sets, query, watched);
        constexpr double kSetUpShare = 0.5;
        const auto other = state_->substitute(tried, before, part_of(watched, 0.0, kSetUpShare));
        if (!other.outcome) return {other.outcome.error(), other.policy};
        return other.outcome->state_->ask(sets, query, part_of(watched, kSetUpShare, 1.0));
      });
  shared.rethrow();
  if (!results) return results;
  failed.erase(failed.begin(), failed.begin() + std::ssize(state_->failed));
  for (DistanceResult& result : *results) {
    keep_reach(query.reach, result);
    result.backend = backend;
    result.fallbacks = failed;
    if (!failed.empty()) result.warnings.push_back({takeover_text(failed, backend)});
  }
  return results;
} catch (const std::bad_alloc&) {
  return out_of_memory_error("query", *state_->domain->input, state_->options.backend);
}

const std::vector<Fallback>& HeatMethod::fallbacks() const { return state_->failed; }

}  // namespace geotherm
