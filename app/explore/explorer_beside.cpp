// SPDX-License-Identifier: MIT
// What an explorer works out beside the distances: methods to hold them against, paths, cells.
#include "app/explore/explorer.h"
#include "app/progress_bar.h"
#include "app/solve_steps.h"
#include "app/told.h"
#include "geotherm/heat_method.h"
#include "geotherm/polyhedral_methods.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {

Result<void> Explorer::make_waves(const Progress& progress) {
  if (waves_) return {};
  auto made = build_wave_surface(model_->model.mesh, progress);
  if (!made) return about_model(model_->model.name, made.error());
  waves_ = *std::move(made);
  return {};
}

/// A heat method begins with what another one has, any other with the model's wave surface.
Result<std::shared_ptr<const DistanceMethod>> Explorer::make(const MethodOptions& options,
                                                             const DistanceMethod* near,
                                                             const Progress& progress) {
  if (options.method == MethodKind::kHeat) {
    return build_method_near(model_->model.mesh, options, near, progress);
  }
  const bool refined = options.refine > 0;
  const std::pair key(options.method, refined);
  if (const auto at = on_waves_.find(key); at != on_waves_.end()) {
    const OnWaves& kept = at->second;
    if (kept.threads == options.threads && kept.refine == options.refine) return kept.method;
    on_waves_.erase(at);
  }
  if (auto made = refined ? Result<void>() : make_waves(part_of(progress, 0.0, 0.5)); !made) {
    return made.error();
  }
  auto made = build_method(model_->model.mesh, options, part_of(progress, 0.5, 1.0), waves_);
  if (made) on_waves_[key] = {*made, options.threads, options.refine};
  return made;
}

/// Those of A, where its method carries them along.
Result<void> Explorer::find_nearest(Explored& explored, const Progress& progress) {
  explored.nearest = explored.a->result.nearest_source;
  if (!explored.nearest.empty()) return {};
  MethodOptions options;
  options.threads = explored.a->options.threads;
  options.method = MethodKind::kWavefront;
  auto method = make(options, nullptr, part_of(progress, 0.0, 0.5));
  if (!method) return method.error();
  auto result = (*method)->solve(explored.set, {.quality = false, .nearest = true},
                                 part_of(progress, 0.5, 1.0));
  if (!result) return about_model(model_->model.name, result.error());
  explored.nearest = std::move(result->nearest_source);
  return {};
}

/// Paths that cannot be found are a matter of their own: the distances are good all the same.
Result<void> Explorer::find_paths(const ExploreRequest& request, Explored& explored,
                                  const Progress& progress) {
  const auto spec = parse_source(*request.target);
  if (!spec) return spec.error();
  const Source target{*spec, "target " + *request.target, ErrorCode::kBadInput};
  const auto placed = resolve_sources({&target, 1}, *model_->model.mesh);
  if (!placed) {
    explored.path_failure = told(placed.error());
    return {};
  }
  const SurfacePoint& point = placed->set.points.front();
  if (!paths_ || paths_->method != explored.a->method) {
    MethodOptions options;
    options.threads = explored.a->options.threads;
    options.method = MethodKind::kWavefront;
    auto near_exact = make(options, nullptr, part_of(progress, 0.0, 0.2));
    if (!near_exact) return near_exact.error();
    paths_ = Paths{explored.a->method,
                   std::make_shared<const TargetPathFinder>(
                       model_->model.mesh, *std::move(near_exact), explored.a->method)};
  }
  auto found = paths_->finder->find(explored.set, point, part_of(progress, 0.2, 1.0));
  if (!found && found.error().code == ErrorCode::kCancelled) return found.error();
  if (!found) {
    explored.path_failure = told(found.error());
    return {};
  }
  explored.paths = std::move(found->paths);
  return {};
}

MethodKind Explorer::reference_of(const ExploreRequest& request, const Answer& answer) const {
  const Index faces = model_->model.mesh->face_count();
  if (request.check == Check::kOn) return usual_reference(answer.options.method, faces);
  if (request.check == Check::kExact) return MethodKind::kExact;
  if (request.check == Check::kWavefrontFine) return MethodKind::kWavefrontFine;
  // While a source is dragged exact distances must take no longer than a frame or two.
  constexpr Index kMaxFacesDragged = 10'000;
  const bool dragged = !request.quality && faces > kMaxFacesDragged;
  return dragged ? MethodKind::kWavefrontFine : reference_for(answer.options.method, faces);
}

/// Holds an answer against a better one, which is kept for the next answer from the same sources.
/// What cannot be checked is a matter of its own: the distances are good all the same.
Result<void> Explorer::check(const ExploreRequest& request, const SourceSet& sources,
                             Answer& answer, const Progress& progress) {
  const std::shared_ptr<const TriangleMesh>& mesh = model_->model.mesh;
  const CheckedAnswers answers{
      *answer.method, answer.options, {&sources, 1}, {&answer.result.distances, 1}};
  MethodOptions options;
  options.threads = answer.options.threads;
  options.method = reference_of(request, answer);
  if (!is_better(options.method, answer.options.method)) {
    if (!request.quality) return {};
    const CheckMode mode = request.check == Check::kOn ? CheckMode::kUsual : CheckMode::kThorough;
    answer.error = std::make_shared<const AccuracyReport>(unchecked(answer.options.method, mode));
    return {};
  }
  if (!reference_ || reference_->answers.method != options.method ||
      reference_->sources != request.sources) {
    reference_.reset();
    const Stopwatch watch;
    auto method = make(options, nullptr, part_of(progress, 0.0, 0.2));
    auto result = method
                      ? (*method)->solve(sources, {.quality = false}, part_of(progress, 0.2, 0.6))
                      : Result<DistanceResult>(method.error());
    if (!result && result.error().code == ErrorCode::kCancelled) return result.error();
    if (!result) {
      answer.warnings.push_back("the distances were not checked: " + told(result.error()));
      return {};
    }
    ReferenceAnswers better;
    better.method = options.method;
    better.distances.push_back(std::move(result->distances));
    better.milliseconds = watch.milliseconds();
    reference_ = Reference{request.sources, std::move(better)};
  }
  AccuracyReport report =
      hold_against(answers.distances, answer.options.method, reference_->answers);
  if (request.quality) {
    auto found = find_remedy(report, mesh, answers, reference_->answers, CheckMode::kUsual,
                             part_of(progress, 0.6, 1.0));
    if (!found) return found;
    auto warning = accuracy_warning(report, accuracy_line(report));
    if (!warning.empty()) answer.warnings.push_back(std::move(warning));
  }
  answer.error = std::make_shared<const AccuracyReport>(std::move(report));
  return {};
}

/// Hands the answers out as they are, and then holds them against better ones.
Result<void> Explorer::check_afterwards(const ExploreRequest& request, Explored& explored,
                                        const Progress& progress, const Early& early) {
  if (request.check != Check::kOn) return {};
  early(explored);
  explored.checked = true;
  for (auto* const answer : {&explored.a, &explored.b}) {
    if (!*answer) continue;
    auto checked = std::make_shared<Answer>(**answer);
    if (auto done = check(request, explored.set, *checked, with_prefix(progress, "checking: "));
        !done) {
      return done;
    }
    *answer = std::move(checked);
  }
  return {};
}

}  // namespace geotherm::app
