// SPDX-License-Identifier: MIT
#include "geotherm/heat_method.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "geotherm/options.h"
#include "solver/accuracy/check_heat.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/heat/factor_memory.h"
#include "solver/heat/heat_state.h"
#include "solver/heat/surface.h"

namespace geotherm {
namespace {

/// Share of set-up before the factorisation.
constexpr double kDomainShare = 0.5;

}  // namespace

std::string backend_name(const HeatOptions& options) {
  return options.backend.empty() ? backend_names().front() : options.backend;
}

int setup_threads(const HeatOptions& options, const Domain::Input& input) {
  constexpr double kCellNanoseconds = 1000;  // at least, whatever the backend
  return threads_worth_starting(thread_count(options.threads),
                                kCellNanoseconds * input.cell_count());
}

Result<void> check_options(const HeatOptions& options) {
  if (auto fits = check_threads(options.threads); !fits) return fits;
  const TimeStep& step = options.time_step;
  const bool absolute = step.rule == TimeRule::kAbsolute;
  const double value = absolute ? step.absolute : step.factor;
  if (!(value > 0) || !std::isfinite(value)) {
    return Error{
        ErrorCode::kBadInput,
        std::string(absolute ? "the time step" : "the time factor") + " is " + rounded_text(value),
        {"it must be a positive number"}};
  }
  if (options.constraint.mode == ConstraintMode::kPenalty &&
      !(options.constraint.penalty > 0 && std::isfinite(options.constraint.penalty))) {
    return Error{ErrorCode::kBadInput,
                 "the penalty is " + rounded_text(options.constraint.penalty),
                 {"it must be a positive number"}};
  }
  const double limit = options.memory_limit_mb;
  if (!(limit >= 0) || !std::isfinite(limit)) {
    return Error{ErrorCode::kBadInput,
                 "the memory limit is " + rounded_text(limit) + " MB",
                 {"it must be a positive number, or 0 for what is free"}};
  }
  return {};
}

Error out_of_memory_error(const std::string& stage, const Domain::Input& input,
                          const std::string& backend) {
  const auto [cell, cells] = input.cell_names();
  const std::string fewer = std::string("a mesh with fewer ") + cells;
  return {ErrorCode::kOutOfMemory,
          "ran out of memory in the " + stage + " for " +
              counted_text(static_cast<std::size_t>(input.cell_count()), cell, cells),
          backend == "cg"
              ? Hint{"take " + fewer}
              : Hint{"try ", SettingHint{"backend", {"cg"}}, ", which needs less, or " + fewer},
          backend};
}

Attempt<HeatMethod> HeatMethod::State::set_up(const std::shared_ptr<const Domain::Input>& input,
                                              const HeatOptions& options,
                                              std::span<const Fallback> failed,
                                              const Progress& progress, const State* earlier) try {
  const auto backend = find_backend(options.backend);
  if (!backend) return {backend.error()};
  auto domain = input->make(**backend, options.laplacian, setup_threads(options, *input),
                            part_of(progress, 0.0, kDomainShare));
  if (!domain) return {domain.error(), policy_after(domain.error())};
  auto state = std::make_shared<State>();
  state->backend = *backend;
  state->domain = std::move(*domain);
  if (earlier != nullptr) {
    state->pool = earlier->pool;
    state->helpers = earlier->helpers;
  }
  auto made = factorised(*state, options, failed, part_of(progress, kDomainShare, 1.0), earlier);
  if (!made.outcome) return made;
  auto timed = std::make_shared<State>(*made.outcome->state_);
  timed->timing.operators = timed->domain->timing.operators;
  timed->timing.stages = timed->domain->timing.stages;
  timed->timing.analyze = timed->domain->timing.analyze;
  timed->timing.setup += timed->timing.operators + timed->timing.analyze;
  return {HeatMethod(std::move(timed))};
} catch (const std::bad_alloc&) {
  return {out_of_memory_error("set-up", *input, options.backend), FallbackPolicy::kFactorless};
}

Attempt<HeatMethod> HeatMethod::State::factorised(const State& from, const HeatOptions& options,
                                                  std::span<const Fallback> failed,
                                                  const Progress& progress,
                                                  const State* earlier) try {
  if (!report(progress, "factorize", 0.0)) return {cancelled_error()};
  Stopwatch watch;
  auto next = std::make_shared<State>(from);
  next->options = options;
  next->failed.assign(failed.begin(), failed.end());
  next->substitutes = std::make_shared<State::Substitutes>();
  auto times =
      diffusion_times(next->domain->component_sizes, next->domain->unit, options.time_step);
  if (!times) return {times.error()};
  next->times = std::move(*times);
  next->timing = {};
  const int threads = setup_threads(options, *next->domain->input);
  const bool iterative = next->backend->iterative();

  if (from.poisson) next->poisson = from.poisson->with(options.constraint, options.precision);
  const PerComponent share = consistent_share(options.variant, next->times.relative);
  const bool same_heat =
      from.heat && from.heat->is_of(next->times.t, share, iterative, options.precision);
  const FactorPlan plan =
      plan_factors(next->boundary(), same_heat ? std::optional(from.boundary()) : std::nullopt,
                   next->poisson != nullptr, threads);
  if (const auto fits = check_factor_memory(*next->domain->analysis, options.backend,
                                            options.precision, plan, options.memory_limit_mb);
      !fits) {
    return {fits.error(), FallbackPolicy::kAny};
  }
  const State& previous = earlier != nullptr ? *earlier : from;
  Result<void> heat_done, poisson_done;
  const int of_heat = next->poisson ? threads : std::max(1, threads / 2);
  const int of_poisson = plan.missing == 1 ? threads : std::max(1, threads - threads / 2);
  run_both(
      threads,
      [&] {
        auto built = HeatStep::build(next->domain, next->times.t, next->boundary(), share,
                                     iterative, options.precision, previous.heat.get(), of_heat,
                                     part_of(progress, 0.0, threads > 1 ? 1.0 : 0.5));
        if (built) {
          next->heat = std::move(*built);
        } else {
          heat_done = built.error();
        }
      },
      [&] {
        if (next->poisson) return;
        auto built =
            PoissonSolver::build(next->domain, options.constraint, iterative, options.precision,
                                 earlier != nullptr ? earlier->poisson.get() : nullptr, of_poisson,
                                 part_of(progress, threads > 1 ? 0.0 : 0.5, 1.0));
        if (built) {
          next->poisson = std::move(*built);
        } else {
          poisson_done = built.error();
        }
      });
  if (!heat_done) {
    const Error error =
        with_time_hint(heat_done.error(), next->times.extreme, options.time_step.rule);
    return {error, is_extreme_time(next->times.extreme) && error.code != ErrorCode::kOutOfMemory
                       ? FallbackPolicy::kNone
                       : policy_after(error)};
  }
  if (!poisson_done) return {poisson_done.error(), policy_after(poisson_done.error())};
  next->warnings = next->domain->findings;
  const HeatMethod made(next);
  const double held = made.memory_mb(), foreseen = made.forecast_mb();
  constexpr double kMore = 1.01;
  if (foreseen > 0 && held > kMore * foreseen) {
    // A backend that keeps numbers wider than was asked of it, where narrow ones would show.
    if (options.memory_limit_mb > 0 && held > options.memory_limit_mb) {
      return {
          Error{ErrorCode::kOutOfMemory,
                "needs " + rounded_text(held) +
                    " MB for factors in doubles, "
                    "since numbers of the matrix differ by too many orders for narrow ones, and "
                    "the limit is " +
                    rounded_text(options.memory_limit_mb) + " MB",
                {"raise ", SettingHint{"memory-limit"}, " or try ", SettingHint{"backend", {"cg"}},
                 ", which holds no factor"},
                options.backend},
          FallbackPolicy::kAny};
    }
    next->warnings.push_back({"the factors are kept in doubles (" + rounded_text(held) +
                              " MB, foreseen " + rounded_text(foreseen) +
                              " MB): numbers of the matrix differ by too many orders"});
  }
  if (!failed.empty()) next->warnings.push_back({takeover_text(failed, options.backend)});
  next->timing.factorize = next->timing.setup = watch.milliseconds();
  if (!report(progress, "factorize", 1.0)) return {cancelled_error()};
  return {HeatMethod(std::move(next))};
} catch (const std::bad_alloc&) {
  return {out_of_memory_error("factorisation", *from.domain->input, options.backend),
          FallbackPolicy::kFactorless};
}

Attempt<std::vector<DistanceResult>> HeatMethod::State::ask(std::span<const SourceSet> sets,
                                                            const QueryOptions& query,
                                                            const Progress& progress) const try {
  const QueryPipeline pipeline{*domain, *heat, *poisson, options, times, *pool, *helpers};
  return run_queries(pipeline, sets, query, progress);
} catch (const std::bad_alloc&) {
  const std::string queries = sets.size() == 1 ? "query" : std::to_string(sets.size()) + " queries";
  return {out_of_memory_error(queries, *domain->input, options.backend),
          FallbackPolicy::kFactorless};
}

const HeatOptions& HeatMethod::options() const { return state_->options; }
double HeatMethod::t() const { return state_->times.model_t; }
double HeatMethod::relative_t() const { return state_->times.relative_t; }
double HeatMethod::grading() const { return state_->times.grading; }
std::array<double, 2> HeatMethod::t_range() const {
  const double edge = state_->domain->unit;
  if (state_->times.t.same()) return {t(), t()};
  return {state_->times.t.least() * edge * edge, state_->times.t.most() * edge * edge};
}
BoundaryRule HeatMethod::boundary() const { return state_->boundary(); }
LaplacianKind HeatMethod::laplacian() const {
  const Surface* const surface = state_->domain->surface();
  return surface != nullptr ? surface->laplacian : LaplacianKind::kCotan;
}
Index HeatMethod::flips() const { return state_->domain->flip_count(); }
const RefinementCounts& HeatMethod::refinement() const { return state_->domain->inserted(); }
std::shared_ptr<const IntrinsicSurface> HeatMethod::delaunay_triangulation() const {
  const Surface* const surface = state_->domain->surface();
  if (surface == nullptr || !surface->serves_waves()) return nullptr;
  return {state_->domain, surface};
}
const SetupTiming& HeatMethod::timing() const { return state_->timing; }
double HeatMethod::memory_mb() const {
  const std::int64_t bytes = state_->heat->stats().bytes + state_->poisson->stats().bytes;
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}
HeatMethod::Fronts HeatMethod::fronts() const {
  const FactorStats heat = state_->heat->stats(), poisson = state_->poisson->stats();
  return {heat.fronts + poisson.fronts, heat.fronts_factored + poisson.fronts_factored};
}
double HeatMethod::forecast_mb() const {
  const FactorPlan plan = plan_factors(state_->boundary(), {}, false, 1);
  const Analysis& analysis = *state_->domain->analysis;
  const Precision precision = state_->options.precision;
  const std::int64_t bytes = analysis.factor_bytes(heat_storage(precision)) * (plan.factors - 1) +
                             analysis.factor_bytes(poisson_storage(precision));
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}
const std::vector<Warning>& HeatMethod::warnings() const { return state_->warnings; }

}  // namespace geotherm
