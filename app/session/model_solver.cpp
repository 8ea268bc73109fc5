// SPDX-License-Identifier: MIT
#include "app/session/model_solver.h"

#include <algorithm>
#include <cmath>

#include "app/session/machine.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "geotherm/polyhedral_methods.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

void add(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

ModelSolver::ModelSolver(Model model, Use use) : model_(std::move(model)), use_(use) {}

void ModelSolver::keep_methods(std::size_t count) {
  kept_methods_ = count;
  if (ready_.size() > count) ready_.erase(ready_.begin(), ready_.end() - static_cast<int>(count));
}

/// A heat method begins with what `near` has; any other with the model's waves, where more are to
/// come.
Result<std::shared_ptr<const DistanceMethod>> ModelSolver::make(const MethodOptions& options,
                                                                const DistanceMethod* near,
                                                                const Progress& progress) {
  if (options.method == MethodKind::kHeat) {
    return build_method_near(model_.mesh, options, near, progress);
  }
  if (use_ == Use::kOneAnswer) return build_method(model_.mesh, options, progress);
  const bool refined = options.refine > 0;
  const std::pair key(options.method, refined);
  if (const auto at = on_waves_.find(key); at != on_waves_.end()) {
    const OnWaves& kept = at->second;
    if (kept.threads == options.threads && kept.refine == options.refine) return kept.method;
    on_waves_.erase(at);
  }
  if (!refined && !waves_) {
    auto made = build_wave_surface(model_.mesh, part_of(progress, 0.0, 0.5));
    if (!made) return made.error();
    waves_ = *std::move(made);
  }
  auto made = build_method(model_.mesh, options, part_of(progress, 0.5, 1.0), waves_);
  if (made) on_waves_[key] = {*made, options.threads, options.refine};
  return made;
}

Result<ReadyMethod> ModelSolver::prepare(const MethodOptions& options, const Progress& progress) {
  const auto known = std::ranges::find_if(
      ready_, [&options](const ReadyMethod& ready) { return same_method(ready.options, options); });
  if (known != ready_.end()) {
    std::rotate(known, known + 1, ready_.end());
    ready_.back().options = options;
    return ready_.back();
  }
  if (auto pin = check_pin(options.constraint, *model_.mesh); !pin) return pin.error();
  const ReadyMethod* const near = ready_.empty() ? nullptr : &ready_.front();
  const Stopwatch watch;
  auto made = make(options, near ? near->method.get() : nullptr, progress);
  if (!made) return about_model(model_.name, made.error());
  SetupTiming setup = (*made)->timing();
  if (near && setup.operators == 0) {  // taken over
    setup.operators = near->setup.operators;
    setup.analyze = near->setup.analyze;
  }
  ReadyMethod ready{*std::move(made), options, setup, watch.milliseconds()};
  if (ready_.size() >= kept_methods_) ready_.erase(ready_.begin());
  ready_.push_back(ready);
  return ready;
}

Result<std::vector<Index>> ModelSolver::nearest_sources(const SourceSet& sources,
                                                        std::span<const double> distances,
                                                        int threads, const Progress& progress) {
  if (source_groups(sources).count == 1) {
    std::vector<Index> only(distances.size(), kNoIndex);
    for (std::size_t v = 0; v < only.size(); ++v) {
      if (std::isfinite(distances[v])) only[v] = 0;
    }
    return only;
  }
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  options.threads = threads;
  const auto method = make(options, nullptr, part_of(progress, 0.0, 0.5));
  if (!method) return about_model(model_.name, method.error());
  auto result =
      (*method)->solve(sources, {.quality = false, .nearest = true}, part_of(progress, 0.5, 1.0));
  if (!result) return about_model(model_.name, result.error());
  return std::move(result->nearest_source);
}

/// The answer, and nothing about the mesh and the error yet.
Result<Answer> ModelSolver::distances(const MethodOptions& options, const ResolvedSources& sources,
                                      const QueryOptions& query, const Progress& progress) {
  constexpr double kQueryFrom = 0.9;
  auto ready = prepare(options, part_of(progress, 0.0, kQueryFrom));
  if (!ready) return ready.error();
  if (!report(progress, "solve", kQueryFrom)) return cancelled_error();
  auto result = ready->method->solve(sources.set, query, part_of(progress, kQueryFrom, 1.0));
  if (!result) return about_model(model_.name, result.error());
  Answer answer;
  answer.model = model_;
  answer.method = std::move(ready->method);
  answer.options = options;
  answer.setup = ready->setup;
  answer.setup_ms = ready->setup_ms;
  answer.sources = sources.set;
  answer.result = *std::move(result);
  if (query.nearest && answer.result.nearest_source.empty()) {
    auto nearest = nearest_sources(sources.set, answer.result.distances, options.threads,
                                   with_prefix(progress, "nearest sources: "));
    if (!nearest) return nearest.error();
    answer.result.nearest_source = *std::move(nearest);
  }
  answer.distance = summarize(answer.result.distances);
  answer.peak_rss_mb = peak_rss_mb();
  if (use_ == Use::kOneAnswer) add(answer.warnings, model_.notes);
  add(answer.warnings, told(answer.method->warnings()));
  add(answer.warnings, sources.warnings);
  add(answer.warnings, told(answer.result.warnings));
  return answer;
}

void ModelSolver::describe_mesh(Answer& answer) const {
  answer.mesh = *summary_;
  add(answer.warnings, unreached_notes(*summary_, answer.distance.unreached));
}

Result<Answer> ModelSolver::solve(const MethodOptions& options, const ResolvedSources& sources,
                                  const Wanted& wanted, const Progress& progress) {
  const bool checks = wanted.check.mode != CheckMode::kNone;
  const double solved = checks ? 0.8 : 1.0;  // share of the whole
  auto answer = distances(options, sources, wanted.query, part_of(progress, 0.0, solved));
  if (!answer) return answer;
  const Progress checking = part_of(progress, solved, 1.0);
  const int threads = thread_count(options.threads);
  Result<AccuracyReport> report = AccuracyReport();
  run_both(  // neither needs the other
      checks ? threads : 1,
      [&] {
        if (!checks) return;
        const MethodKind kind = answer->method->kind();
        report = hold(checked_answers(*answer),
                      reference_in(wanted.check.mode, kind, model_.mesh->face_count()),
                      wanted.check.mode, *answer->method, with_prefix(checking, "checking: "));
      },
      [&] {
        if (summary_) return;
        const Stopwatch watch;
        summary_ = summarize_mesh(*model_.mesh, checks ? std::max(1, threads - 1) : threads);
        answer->report_ms = watch.milliseconds();
      });
  if (!report) return report.error();
  if (checks && report->is_poor() && wanted.check.on_poor == OnPoor::kBetter) {
    answer->error = std::make_shared<const AccuracyReport>(*std::move(report));
    auto done = replace(*answer, sources, wanted, with_prefix(checking, "answering again: "));
    if (!done) return done.error();
    return answer;
  }
  describe_mesh(*answer);
  if (!checks) return answer;
  if (auto done = settle(*answer, *std::move(report), wanted.check, checking); !done) {
    return done.error();
  }
  return answer;
}

Result<TargetPaths> ModelSolver::paths_to(const SurfacePoint& target, const Answer& answer,
                                          const Progress& progress) {
  if (!paths_ || paths_->method != answer.method) {
    MethodOptions options;
    options.method = MethodKind::kWavefront;
    options.threads = answer.options.threads;
    auto near_exact = make(options, nullptr, part_of(progress, 0.0, 0.2));
    if (!near_exact) return about_model(model_.name, near_exact.error());
    paths_ = Paths{answer.method, std::make_shared<const TargetPathFinder>(
                                      model_.mesh, *std::move(near_exact), answer.method)};
  }
  return paths_->finder->find(answer.sources, target, part_of(progress, 0.2, 1.0));
}

}  // namespace geotherm::app
