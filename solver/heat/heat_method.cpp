// SPDX-License-Identifier: MIT
#include "solver/heat/heat_method.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "solver/core/number_text.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"
#include "solver/heat/heat_step.h"
#include "solver/heat/judge.h"
#include "solver/heat/option_text.h"
#include "solver/heat/poisson.h"
#include "solver/heat/query.h"

namespace geotherm {

struct HeatMethod::State {
  HeatOptions options;
  const Backend* backend = nullptr;
  std::shared_ptr<const Surface> surface;
  std::shared_ptr<const HeatStep> heat;
  std::shared_ptr<const PoissonSolver> poisson;
  std::shared_ptr<BlockPool> pool = std::make_shared<BlockPool>();
  double t = 0;  // model units squared
  double unit_t =
      0;  // the same in squares of the mean edge, right where t leaves the doubles' range
  SetupTiming timing;
  std::vector<std::string> warnings;
};

namespace {

Result<void> check(const HeatOptions& options) {
  const TimeStep& step = options.time_step;
  const bool absolute = step.rule == TimeRule::kAbsolute;
  const double value = absolute ? step.absolute : step.factor;
  if (!(value > 0) || !std::isfinite(value)) {
    return Error{ErrorCode::kBadInput, std::string(absolute ? "the time step" : "the time factor") +
                                           " is " + rounded_text(value) +
                                           "; it must be a positive number"};
  }
  if (options.constraint.mode == ConstraintMode::kPenalty &&
      !(options.constraint.penalty > 0 && std::isfinite(options.constraint.penalty))) {
    return Error{ErrorCode::kBadInput, "the penalty is " +
                                           rounded_text(options.constraint.penalty) +
                                           "; it must be a positive number"};
  }
  return {};
}

/// Diffusion time in squares of the mean edge.
double unit_time(const Surface& surface, const TimeStep& step) {
  switch (step.rule) {
    case TimeRule::kMeanEdge:
      return step.factor;
    case TimeRule::kMeanFaceArea:
      return step.factor * surface.unit_area / static_cast<double>(surface.clean_faces.size());
    case TimeRule::kAbsolute:
      break;
  }
  return step.absolute / surface.mean_edge / surface.mean_edge;
}

/// The public functions let no std::bad_alloc out.
Error out_of_memory(const char* stage, Index faces, const std::string& backend) {
  return {ErrorCode::kOutOfMemory, std::string("the memory ended in the ") + stage + " for " +
                                       std::to_string(faces) + " faces with " + backend +
                                       (backend == "cg" ? "; take a mesh with fewer faces"
                                                        : "; try --backend cg, which needs less, "
                                                          "or a mesh with fewer faces")};
}

/// The share of set-up that has no numbers to factorise.
constexpr double kSurfaceShare = 0.5;

std::string backend_name(const HeatOptions& options) {
  return options.backend.empty() ? backend_names().front() : options.backend;
}

/// Half of the mass is consistent where the mesh resolves the diffusion length, t >= 0.8 h^2; the
/// expansion behind it fails below, and at t = 0.2 h^2 the lumped mass is better (measured).
double consistent_share(Variant variant, double unit_t) {
  return variant == Variant::kClassic ? 0.0 : 0.5 * std::clamp((unit_t - 0.2) / 0.6, 0.0, 1.0);
}

}  // namespace

Result<HeatMethod> HeatMethod::build(std::shared_ptr<const TriangleMesh> mesh,
                                     const HeatOptions& options, const Progress& progress) try {
  const auto backend = find_backend(backend_name(options));
  if (!backend) return backend.error();
  if (const auto valid = check(options); !valid) return valid.error();
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  Stopwatch watch;
  auto surface = build_surface(mesh, **backend, options.laplacian, thread_count(options.threads),
                               part_of(watched, 0.0, kSurfaceShare));
  if (!surface) return surface.error();
  auto state = std::make_shared<State>();
  state->backend = *backend;
  state->surface = std::move(*surface);
  const HeatMethod prepared(state);
  auto method = prepared.with(options, part_of(watched, kSurfaceShare, 1.0));
  if (!method) return method.error();
  auto timed = std::make_shared<State>(*method->state_);
  timed->timing.operators = timed->surface->operators_ms;
  timed->timing.analyze = timed->surface->analyze_ms;
  timed->timing.setup = watch.milliseconds();
  return HeatMethod(std::move(timed));
} catch (const std::bad_alloc&) {
  return out_of_memory("set-up", mesh->face_count(), backend_name(options));
}

Result<HeatMethod> HeatMethod::with(const HeatOptions& options, const Progress& progress) const
    try {
  if (const auto valid = check(options); !valid) return valid.error();
  const std::string name = backend_name(options);
  const bool fresh = state_->heat == nullptr;
  if (!fresh &&
      (name != state_->backend->name() || options.laplacian != state_->options.laplacian)) {
    return build(state_->surface->mesh, options, progress);
  }
  SharedProgress shared(progress);
  const Progress watched = shared.function();
  if (!report(watched, "factorize", 0.0)) return cancelled_error();
  Stopwatch watch;
  auto next = std::make_shared<State>(*state_);
  next->options = options;
  next->options.backend = name;
  const double edge = next->surface->mean_edge;
  const double unit_t = unit_time(*next->surface, options.time_step);
  if (!(unit_t > 0) || !std::isfinite(unit_t)) {
    return Error{ErrorCode::kBadInput, "the diffusion time is " + rounded_text(unit_t) +
                                           " squared mean edges, where an edge is " +
                                           rounded_text(edge) + " long; choose one near 1"};
  }
  next->unit_t = unit_t;
  next->t = options.time_step.rule == TimeRule::kAbsolute ? options.time_step.absolute
                                                          : unit_t * edge * edge;
  next->timing = {};
  const int threads = thread_count(options.threads);
  const bool iterative = next->backend->iterative();

  if (!fresh) next->poisson = state_->poisson->with(options.constraint);
  Result<void> heat_done, poisson_done;
  run_both(
      threads,
      [&] {
        auto built = HeatStep::build(next->surface, unit_t, options.boundary,
                                     consistent_share(options.variant, unit_t), iterative,
                                     state_->heat.get(), std::max(1, threads / 2),
                                     part_of(watched, 0.0, threads > 1 ? 1.0 : 0.5));
        if (built) {
          next->heat = std::move(*built);
        } else {
          heat_done = built.error();
        }
      },
      [&] {
        if (next->poisson) return;
        auto built = PoissonSolver::build(next->surface, options.constraint, iterative,
                                          std::max(1, threads - threads / 2),
                                          part_of(watched, threads > 1 ? 0.0 : 0.5, 1.0));
        if (built) {
          next->poisson = std::move(*built);
        } else {
          poisson_done = built.error();
        }
      });
  if (!heat_done) return with_time_cure(heat_done.error(), unit_t);
  if (!poisson_done) return poisson_done.error();
  next->warnings = next->surface->warnings;
  if (options.time_step.rule != TimeRule::kAbsolute && !next->surface->scale_warning.empty()) {
    next->warnings.push_back(next->surface->scale_warning);
  }
  next->timing.factorize = next->timing.setup = watch.milliseconds();
  if (!report(watched, "factorize", 1.0)) return cancelled_error();
  return HeatMethod(std::move(next));
} catch (const std::bad_alloc&) {
  return out_of_memory("factorisation", state_->surface->mesh->face_count(), backend_name(options));
}

Result<std::vector<DistanceResult>> HeatMethod::solve_each(std::span<const SourceSet> sets,
                                                           const QueryOptions& query,
                                                           const Progress& progress) const try {
  const QueryPipeline pipeline{*state_->surface, *state_->heat,  *state_->poisson,
                               state_->options,  state_->unit_t, *state_->pool};
  auto results = run_queries(pipeline, sets, query, progress);
  if (results || results.error().code != ErrorCode::kOutOfMemory) return results;
  throw std::bad_alloc();  // for the sizes in the message
} catch (const std::bad_alloc&) {
  const std::string queries = sets.size() == 1 ? "query" : std::to_string(sets.size()) + " queries";
  return out_of_memory(queries.c_str(), state_->surface->mesh->face_count(),
                       state_->options.backend);
}

const HeatOptions& HeatMethod::options() const { return state_->options; }
double HeatMethod::t() const { return state_->t; }
LaplacianKind HeatMethod::laplacian() const { return state_->surface->laplacian; }
Index HeatMethod::flips() const { return static_cast<Index>(state_->surface->flips.size()); }
const SetupTiming& HeatMethod::timing() const { return state_->timing; }
double HeatMethod::memory_mb() const {
  const std::int64_t bytes = state_->heat->stats().bytes + state_->poisson->stats().bytes;
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}
const std::vector<std::string>& HeatMethod::warnings() const { return state_->warnings; }

}  // namespace geotherm
