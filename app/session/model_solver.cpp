// SPDX-License-Identifier: MIT
#include "app/session/model_solver.h"

#include <algorithm>
#include <cmath>

#include "app/session/machine.h"
#include "app/session/progress.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/heat_method.h"
#include "geotherm/polyhedral_methods.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

void add(std::vector<Warning>& all, const std::vector<Warning>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

const ReadyMethod* find_in(const std::vector<ReadyMethod>& all, const MethodOptions& options) {
  const auto known = std::ranges::find_if(
      all, [&options](const ReadyMethod& ready) { return same_method(ready.options, options); });
  return known == all.end() ? nullptr : &*known;
}

}  // namespace

void name_reference_method(const Space& space, std::vector<Warning>& warnings) {
  for (Warning& warning : warnings) {
    for (auto& part : warning.hint) {
      auto* const setting = std::get_if<SettingHint>(&part);
      if (setting == nullptr || setting->name != "method") continue;
      if (space.reference_method() == MethodKind::kHeat) {  // there is no other
        warning.hint.clear();
        break;
      }
      setting->values = {to_text(space.reference_method())};
    }
  }
}

ModelSolver::ModelSolver(Model model, Use use) : model_(std::move(model)), use_(use) {}

bool ModelSolver::is_wanted(const ReadyMethod& ready) const {
  return std::ranges::any_of(wanted_, [&ready](const MethodOptions& wanted) {
    return same_method(wanted, ready.options);
  });
}

void ModelSolver::drop_unwanted() {
  std::erase_if(ready_, [this](const ReadyMethod& ready) { return !is_wanted(ready); });
  std::erase_if(earlier_, [this](const ReadyMethod& ready) { return !is_wanted(ready); });
}

void ModelSolver::move(Model model) {
  model_ = std::move(model);
  for (ReadyMethod& ready : ready_) earlier_.push_back(std::move(ready));
  ready_.clear();
  waves_.clear();
  on_waves_.clear();
  reference_.reset();
  paths_.reset();
}

void ModelSolver::move(Model model, ReadyMethod ready) {
  move(std::move(model));
  earlier_.clear();
  ready_.push_back(std::move(ready));
}

const ReadyMethod* ModelSolver::find_ready(const MethodOptions& options) const {
  return find_in(ready_, options);
}

/// Builds a heat method from the parts of `other`, and in a session what walks over a wave surface
/// on the cached one.
Result<std::shared_ptr<const DistanceMethod>> ModelSolver::make(const MethodOptions& options,
                                                                const DistanceMethod* other,
                                                                const Progress& progress) {
  if (model_.space) return build_method_sharing(*model_.space, options, other, progress);
  const ReadyMethod* earlier = find_in(earlier_, options);
  if (earlier == nullptr && options.method == MethodKind::kHeat) {
    const auto heat = std::ranges::find(
        earlier_, MethodKind::kHeat, [](const ReadyMethod& ready) { return ready.options.method; });
    if (heat != earlier_.end() && other == nullptr) earlier = &*heat;
  }
  if (earlier != nullptr) {
    return build_method_moved(model_.mesh, options, earlier->method.get(), progress);
  }
  if (beside_ && other == nullptr && options.method == MethodKind::kHeat) {
    auto made = HeatMethod::build(model_.mesh, options, progress, beside_->starter());
    if (!made) return made.error();
    return std::shared_ptr<const DistanceMethod>(
        std::make_shared<const HeatMethod>(*std::move(made)));
  }
  if (options.method == MethodKind::kHeat) {
    return build_method_sharing(model_.mesh, options, other, progress);
  }
  if (use_ == Use::kOneAnswer) return build_method(model_.mesh, options, progress);
  const bool refined = options.refine > 0;
  const std::pair key(options.method, refined);
  if (const auto at = on_waves_.find(key); at != on_waves_.end()) {
    const OnWaves& kept = at->second;
    if (kept.threads == options.threads && kept.refine == options.refine) return kept.method;
    on_waves_.erase(at);
  }
  auto& waves = waves_[walks_on_inserted(options.method)];
  auto made = build_method(model_.mesh, options, progress, refined ? nullptr : waves);
  if (!made) return made;
  on_waves_[key] = {*made, options.threads, options.refine};
  const auto* const walks = dynamic_cast<const WaveMethod*>(made->get());
  if (walks != nullptr && !refined) waves = walks->surface();
  return made;
}

Result<ReadyMethod> ModelSolver::prepare(const MethodOptions& options, const Progress& progress) {
  if (const ReadyMethod* const known = find_ready(options)) return *known;
  if (auto pin = check_pin(options.constraint, model_); !pin) return pin.error();
  const ReadyMethod* other = nullptr;
  for (const ReadyMethod& ready : ready_) {
    if (other == nullptr || (is_wanted(*other) && !is_wanted(ready))) other = &ready;
  }
  const Stopwatch watch;
  auto made = make(options, other ? other->method.get() : nullptr, progress);
  if (!made) return about_model(model_.name, made.error());
  SetupTiming setup = (*made)->timing();
  if (other && setup.operators == 0) {  // taken over
    setup.operators = other->setup.operators;
    setup.analyze = other->setup.analyze;
  }
  drop_unwanted();
  std::erase_if(earlier_, [&options](const ReadyMethod& earlier) {
    return same_method(earlier.options, options);
  });
  ready_.push_back({*std::move(made), options, setup, watch.milliseconds()});
  return ready_.back();
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
  options.method = model_.space ? model_.space->reference_method()
                                : usual_reference(MethodKind::kHeat, model_.mesh->face_count());
  options.threads = threads;
  if (options.method == MethodKind::kHeat) {  // there is no wave
    return about_model(model_.name,
                       {ErrorCode::kNotAvailable,
                        "no method tells the nearest source on a surface of edge lengths",
                        {"compare the distances from each source by itself"}});
  }
  const auto method = make(options, nullptr, part_of(progress, 0.0, 0.5));
  if (!method) return about_model(model_.name, method.error());
  auto result =
      (*method)->solve(sources, {.quality = false, .nearest = true}, part_of(progress, 0.5, 1.0));
  if (!result) return about_model(model_.name, result.error());
  std::vector<Index>& nearest = result->nearest_source;
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    if (!std::isfinite(distances[v])) nearest[v] = kNoIndex;
  }
  return std::move(nearest);
}

/// Leaves of an answer what is within reach, as distances of all vertices.
void keep_within(const Reach& reach, Answer& answer) {
  DistanceResult& result = answer.result;
  const auto spread = [&](auto& values, auto beyond) {
    if (values.empty() || reach.targets.empty()) return;
    std::vector<std::remove_const_t<decltype(beyond)>> all(
        static_cast<std::size_t>(answer.model.mesh->vertex_count()), beyond);
    const bool of_targets = !result.vertices.empty();
    for (std::size_t i = 0; i < reach.targets.size(); ++i) {
      const auto v = static_cast<std::size_t>(reach.targets[i]);
      all[v] = values[of_targets ? i : v];
    }
    values = std::move(all);
  };
  spread(result.distances, kUnreached);
  spread(result.nearest_source, kNoIndex);
  for (std::size_t v = 0; v < result.distances.size(); ++v) {
    if (result.distances[v] <= reach.max_distance) continue;
    result.distances[v] = kUnreached;
    if (!result.nearest_source.empty()) result.nearest_source[v] = kNoIndex;
  }
  result.vertices = reach.targets;
  answer.reach = reach;
  answer.distance = summarize(result.distances);
}

/// Solves and fills the answer, except for mesh summary and error.
Result<Answer> ModelSolver::distances(const MethodOptions& options, const ResolvedSources& sources,
                                      const QueryOptions& query, const Progress& progress) {
  const double set_up = find_ready(options) ? 0.0 : 0.9;  // share of the progress
  auto ready = prepare(options, part_of(progress, 0.0, set_up));
  if (!ready) return ready.error();
  if (!report(progress, "solve", set_up)) return cancelled_error();
  auto result = ready->method->solve(sources.set, query, part_of(progress, set_up, 1.0));
  if (!result) return about_model(model_.name, result.error());
  Answer answer;
  answer.model = model_;
  answer.method = std::move(ready->method);
  answer.options = options;
  answer.setup = ready->setup;
  answer.setup_ms = ready->setup_ms;
  answer.sources = sources.set;
  answer.result = *std::move(result);
  if (query.reach.is_bounded()) keep_within(query.reach, answer);
  if (query.nearest && answer.result.nearest_source.empty()) {
    auto nearest = nearest_sources(sources.set, answer.result.distances, options.threads,
                                   with_prefix(progress, "nearest sources: "));
    if (!nearest) return nearest.error();
    answer.result.nearest_source = *std::move(nearest);
  }
  answer.distance = summarize(answer.result.distances);
  answer.peak_rss_mb = peak_rss_mb();
  if (use_ == Use::kOneAnswer) add(answer.warnings, model_.notes);
  add(answer.warnings, answer.method->warnings());
  add(answer.warnings, sources.warnings);
  add(answer.warnings, answer.result.warnings);
  if (model_.space) name_reference_method(*model_.space, answer.warnings);
  return answer;
}

void ModelSolver::describe_mesh(Answer& answer) const {
  answer.mesh = *summary_;
  if (answer.reach.is_bounded()) return;
  auto unreached = static_cast<Index>(answer.distance.unreached);
  if (!model_.space) {
    // Sessions answer often, and a weld may take as long as an answer.
    const TriangleMesh* const whole = use_ == Use::kOneAnswer ? model_.mesh.get() : nullptr;
    return add(answer.warnings, unreached_notes(*summary_, unreached, whole));
  }
  if (model_.space->has_walls()) unreached -= model_.space->unused_vertices();
  if (unreached <= 0) return;
  answer.warnings.push_back({counted(unreached, "vertex is", "vertices are") + " in no " +
                             model_.space->words().cell +
                             " that a source reaches; the distance there is infinite"});
}

Result<Answer> ModelSolver::solve(const MethodOptions& options, const ResolvedSources& sources,
                                  const Wanted& wanted, const Progress& progress) {
  const Reach& reach = wanted.query.reach;
  if (!reach.is_bounded()) return answer_all(options, sources, wanted, progress);
  Wanted of_all = wanted;
  if (wanted.check.against != Check::kOff &&
      is_better(reference_of(options.method, wanted.check), options.method)) {
    of_all.query.reach = {};
  }
  auto answer = answer_all(options, sources, of_all, progress);
  if (answer && !answer->reach.is_bounded()) keep_within(reach, *answer);
  return answer;
}

/// Has the reference of one answer solved while its heat method is set up, where that is worth it.
void ModelSolver::begin_reference(const MethodOptions& options, const ResolvedSources& sources,
                                  const Wanted& wanted) {
  if (wanted.check.against == Check::kOff || use_ != Use::kOneAnswer || model_.space) return;
  const bool plain = options.refine == 0 && model_.mesh->same_as().empty();
  if (options.method != MethodKind::kHeat || !plain || find_ready(options) != nullptr) return;
  if (!ReferenceBeside::is_worth_it(*model_.mesh, thread_count(options.threads))) return;
  // Another one's memory might be missed by the factors.
  const MethodKind kind = reference_of(options.method, wanted.check);
  if (kind != MethodKind::kWavefront) return;
  beside_ = std::make_shared<ReferenceBeside>(model_.mesh, kind, std::vector{sources.set});
}

Result<Answer> ModelSolver::answer_all(const MethodOptions& options, const ResolvedSources& sources,
                                       const Wanted& wanted, const Progress& progress) {
  const bool checks = wanted.check.against != Check::kOff;
  const double solved = checks ? 0.8 : 1.0;  // share of the whole
  begin_reference(options, sources, wanted);
  auto answer = distances(options, sources, wanted.query, part_of(progress, 0.0, solved));
  if (!answer) {
    beside_.reset();
    return answer;
  }
  const Progress checking = part_of(progress, solved, 1.0);
  const int threads = thread_count(options.threads);
  Result<AccuracyReport> report = AccuracyReport();
  run_both(  // neither needs the other
      checks ? threads : 1,
      [&] {
        if (!checks) return;
        report = compare_with(
            checked_answers(*answer), reference_of(answer->method->kind(), wanted.check),
            wanted.check.against, *answer->method, with_prefix(checking, "checking: "));
      },
      [&] {
        if (summary_) return;
        const Stopwatch watch;
        summary_ = summarize_mesh(*model_.mesh, checks ? std::max(1, threads - 1) : threads);
        describe_space(model_, *summary_);
        answer->report_ms = watch.milliseconds();
      });
  if (!report) return report.error();
  describe_mesh(*answer);
  if (!checks) return answer;
  Result<void> done;
  if (report->is_poor() && wanted.check.on_poor == OnPoor::kBetter) {
    answer->error = std::make_shared<const AccuracyReport>(*std::move(report));
    done = replace(*answer, sources, wanted, with_prefix(checking, "answering again: "));
  } else {
    done = settle(*answer, *std::move(report), wanted.check, checking);
  }
  if (!done) return done.error();
  return answer;
}

Result<TargetPaths> ModelSolver::paths_to(const SurfacePoint& target, const Answer& answer,
                                          PathKind kind, const Progress& progress) {
  if (auto surface = refuse_space(model_, "paths are"); !surface) return surface.error();
  if (!paths_ || paths_->method != answer.method) {
    auto near_exact = make(better_options(answer.options, MethodKind::kWavefront), nullptr,
                           part_of(progress, 0.0, 0.2));
    if (!near_exact) return about_model(model_.name, near_exact.error());
    paths_ = Paths{answer.method, std::make_shared<const TargetPathFinder>(
                                      model_.mesh, *std::move(near_exact), answer.method)};
  }
  return paths_->finder->find(answer.sources, target, kind, part_of(progress, 0.2, 1.0));
}

}  // namespace geotherm::app
