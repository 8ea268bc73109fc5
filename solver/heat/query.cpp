// SPDX-License-Identifier: MIT
#include "solver/heat/heat_state.h"

#include <algorithm>
#include <cmath>

#include "geotherm/many.h"
#include "solver/accuracy/check_heat.h"
#include "solver/accuracy/distance_bounds.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/heat/factor_memory.h"
#include "solver/heat/normalize.h"
#include "solver/method/solve_sets.h"

namespace geotherm {
namespace {

/// What an iterative query has behind it after the heat step and after the Poisson step.
constexpr double kHeatShare = 0.3;
constexpr double kSolvedShare = 0.95;

struct SetBlock {
  std::size_t first = 0;
  std::vector<SourceAnchors> anchors;
};

/// Cuts the source sets into blocks; a set that changes the matrix is alone in its block. A
/// column's last bits depend on the width of its block, so that each set whose number is a multiple
/// of kSetsInBlock begins one whatever went before: sets that come in chunks of such a multiple get
/// the same blocks.
Result<std::vector<SetBlock>> cut_into_blocks(const QueryPipeline& p,
                                              std::span<const SourceSet> sets) {
  std::vector<SetBlock> blocks;
  bool open = false;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    auto placed = p.domain.place(sets[i]);
    if (!placed) return placed.error();
    const bool alone = p.heat.needs_own_system(*placed, p.options.heat);
    if (!open || alone || i % kSetsInBlock == 0) blocks.push_back({i, {}});
    blocks.back().anchors.push_back(std::move(*placed));
    open = !alone;
  }
  return blocks;
}

/// Rows that are held at 0 for every source set, except its own sources.
std::span<const char> held_at_zero(const QueryPipeline& p) {
  if (p.heat.boundary() != BoundaryRule::kDirichlet) return {};
  return p.domain.on_boundary;
}

/// The most extreme diffusion time of the components that hold a source.
double extreme_time(const DiffusionTimes& times, const SourceAnchors& anchors) {
  double extreme = times.relative.of(anchors.components.front());
  for (const Index component : anchors.components) {
    const double t = times.relative.of(component);
    if (std::abs(std::log(t)) > std::abs(std::log(extreme))) extreme = t;
  }
  return extreme;
}

double extreme_time(const DiffusionTimes& times, const std::vector<SourceAnchors>& block) {
  double extreme = 1;
  for (const SourceAnchors& anchors : block) {
    const double t = extreme_time(times, anchors);
    if (std::abs(std::log(t)) > std::abs(std::log(extreme))) extreme = t;
  }
  return extreme;
}

/// Who may answer a block of sources after this error.
FallbackPolicy policy_after_query(const Error& error, double extreme) {
  if (error.code == ErrorCode::kOutOfMemory) return FallbackPolicy::kFactorless;
  const bool helpless = error.code == ErrorCode::kNumericalFailure && is_extreme_time(extreme);
  return helpless || policy_after(error) == FallbackPolicy::kNone ? FallbackPolicy::kNone
                                                                  : FallbackPolicy::kFactored;
}

/// As many threads as memory allows, up to `threads`, where each may hold a factor of its own.
Result<int> threads_in_memory(const QueryPipeline& p, const std::vector<SetBlock>& blocks,
                              int threads) {
  const auto makes_factor = [&p](const SetBlock& block) {
    return p.heat.needs_own_system(block.anchors.front(), p.options.heat) ||
           std::ranges::any_of(block.anchors,
                               [&p](const auto& set) { return p.poisson.needs_own_system(set); });
  };
  int own = static_cast<int>(
      std::min<std::ptrdiff_t>(std::ranges::count_if(blocks, makes_factor), threads));
  if (own == 0) return threads;
  for (;; own = threads = own - 1) {
    FactorPlan plan = plan_factors(p.heat.boundary(), {}, false, 1);
    plan.factors += own;
    plan.missing = plan.at_once = own;
    const auto fits = check_factor_memory(*p.domain.analysis, p.options.backend,
                                          p.options.precision, plan, p.options.memory_limit_mb);
    if (fits) return threads;
    if (own == 1) return fits.error();
  }
}

/// About how long a query takes one thread, in nanoseconds, as measured from 1,000 faces to a
/// million.
double query_nanoseconds(const QueryPipeline& p, bool quality) {
  constexpr double kEntry = 1;  // the factors are read three times
  constexpr double kIteration = 75, kIterations = 2;
  constexpr double kFace = 10, kFaceChecked = 70, kNearField = 1e5, kNearMarch = 5e4;
  const double faces = p.domain.input->cell_count();
  const auto entries = static_cast<double>(p.poisson.stats().nonzeros);
  const double solves =
      entries > 0 ? kEntry * entries : kIteration * kIterations * faces * std::sqrt(faces);
  const bool inserted = std::ranges::any_of(
      p.domain.component_sizes, [](const ComponentSize& size) { return size.inserted > 0; });
  const double near = inserted ? kNearField : kNearMarch;
  return solves + near + (kFace + (quality ? kFaceChecked : 0)) * faces;
}

/// Near fields of all sets, where they are used. Errors: those of Domain::near_field().
Result<std::vector<std::vector<NearVertex>>> near_fields(const QueryPipeline& p,
                                                         const std::vector<SourceAnchors>& anchors,
                                                         int threads) {
  std::vector<std::vector<NearVertex>> near;
  if (!uses_what_is_known(p.options)) return near;
  near.resize(anchors.size());
  std::vector<Result<void>> done(anchors.size());
  parallel_each<std::size_t>(threads, std::ssize(anchors), 1, [&](std::size_t i) {
    auto found = p.domain.near_field(anchors[i]);
    if (found) {
      near[i] = *std::move(found);
    } else {
      done[i] = found.error();
    }
  });
  for (const Result<void>& each : done) {
    if (!each) return each.error();
  }
  return near;
}

/// `threads`: of this block alone.
Result<void> solve_block(const QueryPipeline& p, std::span<const SourceSet> sets,
                         const std::vector<SourceAnchors>& anchors, const QueryOptions& query,
                         const Workspace& work, std::span<DistanceResult> results,
                         const Progress& progress) {
  Stopwatch watch;
  auto heat = p.heat.diffuse(anchors, p.options.heat, query.quality, work,
                             part_of(progress, 0.0, kHeatShare));
  const auto with_hint = [&](Error error) {
    return with_time_hint(std::move(error), extreme_time(p.times, anchors),
                          p.options.time_step.rule);
  };
  if (!heat) return with_hint(heat.error());
  const double diffuse_ms = watch.lap() - heat->residual_ms;
  if (!report(progress, "solve", kHeatShare)) return cancelled_error();
  const auto field = p.domain.unit_field(
      heat->field, p.options.variant == Variant::kClassic ? 0.0 : p.times.t, work);
  Block b = field->divergence(anchors);
  const auto near = near_fields(p, anchors, work.threads);
  if (!near) return near.error();
  const double gradient_ms = watch.lap();
  Block right;
  if (query.quality) right = b;
  watch.lap();
  auto answer =
      p.poisson.solve(std::move(b), anchors, work, part_of(progress, kHeatShare, kSolvedShare));
  if (!answer) return answer.error();
  const ConstraintMode mode = p.options.constraint.mode;
  const auto normalized = normalize(p.domain, *answer, anchors, *near, mode, work.threads, results);
  if (!normalized) return with_hint(normalized.error());
  const BelowLine below = uses_what_is_known(p.options) ? BelowLine::kRaised : BelowLine::kKept;
  for (std::size_t c = 0; c < anchors.size(); ++c) {
    if (!query.quality && below == BelowLine::kKept) break;
    const Quality before = results[c].quality;
    p.domain.apply_straight_line_bound(sets[c], below, work.threads, results[c]);
    if (!query.quality) results[c].quality = before;  // figures that nobody asked for
  }
  const double poisson_ms = watch.lap();
  if (query.quality && !report(progress, "solve", kSolvedShare)) return cancelled_error();

  const auto share = static_cast<double>(anchors.size());
  for (std::size_t c = 0; c < anchors.size(); ++c) {
    DistanceResult& result = results[c];
    const auto column = static_cast<Eigen::Index>(c);
    result.timing = {diffuse_ms / share, gradient_ms / share, poisson_ms / share,
                     (diffuse_ms + gradient_ms + poisson_ms) / share};
    result.warnings = heat->warnings;
    result.quality.iterations_heat = heat->field.iterations;
    result.quality.iterations_poisson = answer->iterations;
    if (query.quality) {
      const std::vector<double> phi = shifted_phi(p.domain, *answer, anchors[c], mode, column);
      result.quality.heat_residual = heat->residual[c];
      result.quality.poisson_residual =
          poisson_residual(p.domain, phi, right, column, anchors[c],
                           mode == ConstraintMode::kPinSources, work.threads);
      const CellCounts cells =
          field->inspect(phi, column, anchors[c], held_at_zero(p), work.threads, result.quality);
      const auto assessed = assess_heat(p.options, extreme_time(p.times, anchors[c]), cells, result,
                                        0, p.domain.input->cell_names()[1]);
      if (!assessed) return assessed.error();
    }
    if (query.fields) {
      result.heat = heat_in_file_order(p.domain, heat->field, column);
      result.log_heat = log_heat_in_file_order(p.domain, heat->field, column);
    }
  }
  p.pool.give(std::move(heat->field.u));
  p.pool.give(std::move(answer->phi));
  return {};
}

}  // namespace

Attempt<std::vector<DistanceResult>> run_queries(const QueryPipeline& pipeline,
                                                 std::span<const SourceSet> sets,
                                                 const QueryOptions& query,
                                                 const Progress& progress) {
  const Stopwatch watch;
  const auto blocks = cut_into_blocks(pipeline, sets);
  if (!blocks) return {blocks.error()};
  std::vector<DistanceResult> results(sets.size());
  const double placing = watch.milliseconds();
  const int worth =
      threads_worth(thread_count(pipeline.options.threads),
                    query_nanoseconds(pipeline, query.quality) * static_cast<double>(sets.size()));
  const auto fitting =
      threads_in_memory(pipeline, *blocks, std::min<int>(worth, static_cast<int>(blocks->size())));
  if (!fitting) return {fitting.error(), FallbackPolicy::kFactorless};
  const int threads = std::max(1, *fitting);
  const int inside = std::max(1, worth / threads);  // for each block
  const auto job = [&](std::size_t i, const Progress& part) {
    const ThreadCrew crew(inside, &pipeline.helpers);
    const auto& [first, anchors] = (*blocks)[i];
    return solve_block(pipeline, sets.subspan(first, anchors.size()), anchors, query,
                       {pipeline.pool, inside}, std::span(results).subspan(first, anchors.size()),
                       part);
  };
  if (auto failure = share_out_jobs(blocks->size(), threads, pipeline.helpers, progress, job)) {
    const double extreme = extreme_time(pipeline.times, (*blocks)[failure->job].anchors);
    const FallbackPolicy policy = policy_after_query(failure->error, extreme);
    return {std::move(failure->error), policy};
  }
  // Threads work side by side: a set's share of the wall clock is that much smaller.
  for (DistanceResult& result : results) {
    for (double* ms : {&result.timing.diffuse, &result.timing.gradient, &result.timing.poisson,
                       &result.timing.query}) {
      *ms /= threads;
    }
    const double share = placing / static_cast<double>(results.size());
    result.timing.diffuse += share;
    result.timing.query += share;
  }
  return {std::move(results)};
}

}  // namespace geotherm
