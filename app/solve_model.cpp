// SPDX-License-Identifier: MIT
#include "app/solve_model.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "app/machine.h"
#include "app/nearest_sources.h"
#include "app/progress_bar.h"
#include "app/resolve_sources.h"
#include "app/solve_steps.h"
#include "app/told.h"
#include "solver/core/parallel.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

/// Where the query begins, in the progress of the solve.
constexpr double kQueryFrom = 0.9;

/// The answer, and nothing about it yet.
Result<SolveFigures> solve(const Model& model, const MethodOptions& options,
                           const SourceSet& sources, const QueryOptions& query,
                           const Progress& progress) {
  SolveFigures figures;
  figures.model = model;
  figures.options = options;
  figures.sources = sources;
  auto method = build_method(model.mesh, options, part_of(progress, 0.0, kQueryFrom));
  if (!method) return about_model(model.name, method.error());
  figures.method = *std::move(method);
  if (!report(progress, "solve", kQueryFrom)) return cancelled_error();
  auto result = figures.method->solve(sources, query, part_of(progress, kQueryFrom, 1.0));
  if (!result) return about_model(model.name, result.error());
  figures.result = *std::move(result);
  if (query.nearest && figures.result.nearest_source.empty()) {
    auto nearest = nearest_sources(model.mesh, sources, figures.result.distances, options.threads,
                                   with_prefix(progress, "nearest sources: "));
    if (!nearest) return about_model(model.name, nearest.error());
    figures.result.nearest_source = *std::move(nearest);
  }
  figures.peak_rss_mb = peak_rss_mb();  // of the solve, not of the check and the report
  return figures;
}

CheckedAnswers answers_of(const SolveFigures& figures) {
  return {*figures.method, figures.options, {&figures.sources, 1}, {&figures.result.distances, 1}};
}

/// Holds the answer against a better one, and finds out about the mesh: neither needs the other.
/// Errors: kCancelled.
Result<void> check_and_summarize(SolveFigures& figures, CheckMode mode, ReferenceAnswers& better,
                                 const Progress& progress) {
  const int threads = thread_count(figures.options.threads);
  const bool checks = mode != CheckMode::kNone;
  Result<void> done;
  run_both(
      checks ? threads : 1,
      [&] {
        if (!checks) return;
        auto report =
            check_answers(figures.model.mesh, answers_of(figures), mode, better, progress);
        if (report) {
          figures.error = *std::move(report);
        } else {
          done = report.error();
        }
      },
      [&] {
        const Stopwatch watch;
        figures.mesh =
            summarize_mesh(*figures.model.mesh, checks ? std::max(1, threads - 1) : threads);
        figures.report_ms = watch.milliseconds();
      });
  return done;
}

/// Answers by a better method instead. Errors: those of its solve.
Result<SolveFigures> answer_by(MethodKind kind, const SolveFigures& poor, CheckMode mode,
                               const QueryOptions& query, const Progress& progress) {
  auto answered = solve(poor.model, better_options(poor.options, kind), poor.sources, query,
                        part_of(progress, 0.0, 0.5));
  if (!answered) return answered.error();
  ReferenceAnswers better;
  const MethodKind judge = judge_of_better(kind, mode, poor.model.mesh->face_count());
  auto report = check_against(poor.model.mesh, answers_of(*answered), judge, *poor.method, better,
                              part_of(progress, 0.5, 1.0));
  if (!report) return report.error();
  answered->error = *std::move(report);
  return answered;
}

/// Answers by the first better method that is not poor, else by the last one that can answer.
/// Errors: those of the first one's solve, kCancelled.
Result<void> replace_poor(SolveFigures& figures, CheckMode mode, QueryOptions query,
                          const Progress& progress) {
  query.fields = false;
  const auto kinds = better_methods(figures.options.method, mode, figures.model.mesh->face_count());
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, kinds.size()));
  std::optional<SolveFigures> answered;
  double done = 0;
  for (const MethodKind kind : kinds) {
    auto next = answer_by(kind, figures, mode, query, part_of(progress, done, done + share));
    if (!next && (!answered || next.error().code == ErrorCode::kCancelled)) return next.error();
    if (!next) break;
    answered = *std::move(next);
    if (!answered->error->is_poor()) break;
    done += share;
  }
  if (!answered) return {};
  answered->mesh = figures.mesh;
  answered->report_ms = figures.report_ms;
  answered->replaced = std::move(figures.error);
  answered->warnings.push_back(
      replaced_note(figures.options, answered->options, accuracy_line(*answered->replaced)));
  auto poor =
      still_poor_warning(*answered->error, answered->options, accuracy_line(*answered->error));
  if (!poor.empty()) answered->warnings.push_back(std::move(poor));
  figures = *std::move(answered);
  return {};
}

/// Does what is to be done with a poor answer. Errors: kNumericalFailure, kCancelled.
Result<void> settle(SolveFigures& figures, const QueryOptions& query, const CheckSettings& check,
                    const ReferenceAnswers& better, const Progress& progress) {
  if (!figures.error) return {};
  if (figures.error->is_poor() && check.on_poor == OnPoor::kBetter) {
    return replace_poor(figures, check.mode, query, with_prefix(progress, "answering again: "));
  }
  auto found = find_remedy(*figures.error, figures.model.mesh, answers_of(figures), better,
                           check.mode, with_prefix(progress, "finding the cause: "));
  if (!found) return found;
  const std::string line = accuracy_line(*figures.error);
  if (check.on_poor == OnPoor::kFail) {
    if (auto right = refuse_poor(*figures.error, line); !right) {
      return about_model(figures.model.name, right.error());
    }
  }
  if (auto warning = accuracy_warning(*figures.error, line); !warning.empty()) {
    figures.warnings.push_back(std::move(warning));
  }
  return {};
}

}  // namespace

Result<SolveFigures> solve_model(Model model, const MethodOptions& options,
                                 const std::vector<Source>& named, const QueryOptions& query,
                                 const CheckSettings& check, const Progress& progress) {
  if (auto pin = check_pin(options.constraint, *model.mesh); !pin) return pin.error();
  auto sources = resolve_sources(named, *model.mesh);
  if (!sources) return sources.error();
  const double solved = check.mode == CheckMode::kNone ? 1.0 : 0.8;  // share of the whole
  auto figures = solve(model, options, sources->set, query, part_of(progress, 0.0, solved));
  if (!figures) return figures.error();
  ReferenceAnswers better;
  const Progress checking = part_of(progress, solved, 1.0);
  if (auto done =
          check_and_summarize(*figures, check.mode, better, with_prefix(checking, "checking: "));
      !done) {
    return done.error();
  }
  if (auto done = settle(*figures, query, check, better, checking); !done) return done.error();

  figures->distance = summarize(figures->result.distances);
  std::vector<std::string> warnings = figures->model.notes;
  const auto add = [&warnings](const std::vector<std::string>& more) {
    warnings.insert(warnings.end(), more.begin(), more.end());
  };
  add(told(figures->method->warnings()));
  add(sources->warnings);
  add(told(figures->result.warnings));
  add(unreached_notes(figures->mesh, figures->distance.unreached));
  add(figures->warnings);
  figures->warnings = std::move(warnings);
  return figures;
}

}  // namespace geotherm::app
