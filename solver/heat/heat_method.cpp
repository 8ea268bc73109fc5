// SPDX-License-Identifier: MIT
#include "solver/heat/heat_method.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/heat/heat_step.h"
#include "solver/heat/normalize.h"
#include "solver/heat/option_text.h"
#include "solver/heat/poisson.h"
#include "solver/heat/quality.h"
#include "solver/heat/unit_field.h"

namespace geotherm {

struct HeatMethod::State {
  HeatOptions options;
  const Backend* backend = nullptr;
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const HeatStep> heat;
  std::shared_ptr<const PoissonSolver> poisson;
  double t = 0;
  SetupTiming timing;
  std::vector<std::string> warnings;
};

namespace {

/// Source sets solved together: one stream through each factor serves them all.
constexpr std::size_t kSetsAtOnce = 16;

Error cancelled() { return {ErrorCode::kCancelled, "the work was cancelled"}; }

Result<void> check(const HeatOptions& options) {
  const TimeStep& step = options.time_step;
  const bool absolute = step.rule == TimeRule::kAbsolute;
  const double value = absolute ? step.absolute : step.factor;
  if (!(value > 0) || !std::isfinite(value)) {
    return Error{ErrorCode::kBadInput, std::string(absolute ? "the time step" : "the time factor") +
                                           " is " + std::to_string(value) +
                                           "; it must be a positive number"};
  }
  if (options.constraint.mode == ConstraintMode::kPenalty &&
      !(options.constraint.penalty > 0 && std::isfinite(options.constraint.penalty))) {
    return Error{ErrorCode::kBadInput, "the penalty is " +
                                           std::to_string(options.constraint.penalty) +
                                           "; it must be a positive number"};
  }
  return {};
}

double diffusion_time(const Surface& surface, const TimeStep& step) {
  switch (step.rule) {
    case TimeRule::kMeanEdge:
      return step.factor * surface.mean_edge * surface.mean_edge;
    case TimeRule::kMeanFaceArea:
      return step.factor * surface.area / static_cast<double>(surface.clean_faces.size());
    case TimeRule::kAbsolute:
      break;
  }
  return step.absolute;
}

/// Half of the mass is consistent where the mesh resolves the diffusion length, t >= 0.8 h^2; the
/// expansion behind it fails below, and at t = 0.2 h^2 the lumped mass is better (measured).
double consistent_share(Variant variant, double unit_t) {
  return variant == Variant::kClassic ? 0.0 : 0.5 * std::clamp((unit_t - 0.2) / 0.6, 0.0, 1.0);
}

}  // namespace

Result<HeatMethod> HeatMethod::build(std::shared_ptr<const TriangleMesh> mesh,
                                     const HeatOptions& options, const Progress& progress) {
  const auto backend =
      find_backend(options.backend.empty() ? backend_names().front() : options.backend);
  if (!backend) return backend.error();
  if (const auto valid = check(options); !valid) return valid.error();
  if (!report(progress, "operators", 0.0)) return cancelled();
  Stopwatch watch;
  auto surface =
      build_surface(std::move(mesh), **backend, options.laplacian, thread_count(options.threads));
  if (!surface) return surface.error();
  auto state = std::make_shared<State>();
  state->backend = *backend;
  state->surface = std::move(*surface);
  const HeatMethod prepared(state);
  auto method = prepared.with(options, progress);
  if (!method) return method.error();
  auto timed = std::make_shared<State>(*method->state_);
  timed->timing.operators = timed->surface->operators_ms;
  timed->timing.analyze = timed->surface->analyze_ms;
  timed->timing.setup = watch.milliseconds();
  return HeatMethod(std::move(timed));
}

Result<HeatMethod> HeatMethod::with(const HeatOptions& options, const Progress& progress) const {
  if (const auto valid = check(options); !valid) return valid.error();
  const std::string name = options.backend.empty() ? backend_names().front() : options.backend;
  const bool fresh = state_->heat == nullptr;
  if (!fresh &&
      (name != state_->backend->name() || options.laplacian != state_->options.laplacian)) {
    return build(state_->surface->mesh, options, progress);
  }
  if (!report(progress, "factorize", 0.5)) return cancelled();
  Stopwatch watch;
  auto next = std::make_shared<State>(*state_);
  next->options = options;
  next->options.backend = name;
  next->t = diffusion_time(*next->surface, options.time_step);
  next->timing = {};
  const int threads = thread_count(options.threads);
  const bool iterative = next->backend->iterative();
  const double unit_t = next->t / (next->surface->mean_edge * next->surface->mean_edge);

  if (!fresh) next->poisson = state_->poisson->with(options.constraint);
  Result<void> heat_done, poisson_done;
  run_both(
      threads,
      [&] {
        auto built = HeatStep::build(next->surface, unit_t, options.boundary,
                                     consistent_share(options.variant, unit_t), iterative,
                                     state_->heat.get(), std::max(1, threads / 2));
        if (built) {
          next->heat = std::move(*built);
        } else {
          heat_done = built.error();
        }
      },
      [&] {
        if (next->poisson) return;
        auto built = PoissonSolver::build(next->surface, options.constraint, iterative,
                                          std::max(1, threads - threads / 2));
        if (built) {
          next->poisson = std::move(*built);
        } else {
          poisson_done = built.error();
        }
      });
  if (!heat_done) return heat_done.error();
  if (!poisson_done) return poisson_done.error();
  next->warnings = next->surface->warnings;
  next->timing.factorize = next->timing.setup = watch.milliseconds();
  if (!report(progress, "factorize", 1.0)) return cancelled();
  return HeatMethod(std::move(next));
}

Result<DistanceResult> HeatMethod::solve(const SourceSet& sources,
                                         const QueryOptions& query) const {
  auto results = solve_each({&sources, 1}, query);
  if (!results) return results.error();
  return std::move(results->front());
}

namespace {

struct Pipeline {
  const Surface& surface;
  const HeatStep& heat;
  const PoissonSolver& poisson;
  const HeatOptions& options;
  double unit_t;  ///< t in units of the intrinsic mesh squared
};

/// Places as many of the source sets as can be solved in one block.
Result<std::vector<SourceAnchors>> next_group(const Pipeline& p, std::span<const SourceSet> sets) {
  std::vector<SourceAnchors> group;
  for (const SourceSet& set : sets.first(std::min(sets.size(), kSetsAtOnce))) {
    auto placed = place_sources(p.surface, set);
    if (!placed) return placed.error();
    const bool alone = p.heat.needs_own_system(*placed, p.options.heat);
    if (alone && !group.empty()) break;
    group.push_back(std::move(*placed));
    if (alone) break;
  }
  return group;
}

Result<void> solve_group(const Pipeline& p, std::span<const SourceSet> sets,
                         const QueryOptions& query, std::vector<DistanceResult>& results) {
  Stopwatch whole, watch;
  auto placed = next_group(p, sets);
  if (!placed) return placed.error();
  const std::vector<SourceAnchors>& anchors = *placed;
  auto heat = p.heat.diffuse(anchors, p.options.heat, query.quality);
  if (!heat) return heat.error();
  const double diffuse_ms = watch.lap();
  const UnitField field(*p.surface.operators, heat->field,
                        p.options.variant == Variant::kClassic ? 0.0 : p.unit_t);
  const Block b = field.divergence(anchors);
  const double gradient_ms = watch.lap();
  auto answer = p.poisson.solve(b, anchors);
  if (!answer) return answer.error();

  const auto share = static_cast<double>(anchors.size());
  const std::size_t first = results.size();
  std::vector<std::vector<double>> phi(anchors.size());
  for (std::size_t c = 0; c < anchors.size(); ++c) {
    DistanceResult result;
    auto normalized = normalize(p.surface, answer->phi, static_cast<Eigen::Index>(c), anchors[c],
                                p.options.constraint.mode, result);
    if (!normalized) return normalized.error();
    phi[c] = std::move(*normalized);
    results.push_back(std::move(result));
  }
  const double poisson_ms = watch.lap();
  const double query_ms = whole.milliseconds();

  for (std::size_t c = 0; c < anchors.size(); ++c) {
    DistanceResult& result = results[first + c];
    const auto column = static_cast<Eigen::Index>(c);
    result.timing = {diffuse_ms / share, gradient_ms / share, poisson_ms / share, query_ms / share};
    result.warnings = heat->warnings;
    result.quality.iterations_heat = heat->field.iterations;
    result.quality.iterations_poisson = answer->iterations;
    if (query.quality) {
      result.quality.heat_residual = heat->residual[c];
      result.quality.poisson_residual =
          poisson_residual(*p.surface.operators, phi[c], b, column, anchors[c],
                           p.options.constraint.mode == ConstraintMode::kPinSources);
      inspect_faces(*p.surface.operators, field, phi[c], column, anchors[c], result.quality);
      add_quality_warnings(result);
    }
    if (query.fields) result.heat = heat_in_file_order(p.surface, heat->field, column);
  }
  return {};
}

}  // namespace

Result<std::vector<DistanceResult>> HeatMethod::solve_each(std::span<const SourceSet> sets,
                                                           const QueryOptions& query,
                                                           const Progress& progress) const {
  std::vector<DistanceResult> results;
  results.reserve(sets.size());
  const Pipeline pipeline{*state_->surface, *state_->heat, *state_->poisson, state_->options,
                          state_->t / std::pow(state_->surface->mean_edge, 2)};
  while (results.size() < sets.size()) {
    const double done = static_cast<double>(results.size()) / static_cast<double>(sets.size());
    if (!report(progress, "solve", done)) return cancelled();
    const auto solved = solve_group(pipeline, sets.subspan(results.size()), query, results);
    if (!solved) return solved.error();
  }
  return results;
}

const HeatOptions& HeatMethod::options() const { return state_->options; }
double HeatMethod::t() const { return state_->t; }
LaplacianKind HeatMethod::laplacian() const { return state_->surface->laplacian; }
Index HeatMethod::flips() const { return static_cast<Index>(state_->surface->flips.size()); }
const SetupTiming& HeatMethod::timing() const { return state_->timing; }
double HeatMethod::factor_mb() const {
  const std::int64_t bytes = state_->heat->stats().bytes + state_->poisson->stats().bytes;
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}
const std::vector<std::string>& HeatMethod::warnings() const { return state_->warnings; }

}  // namespace geotherm
