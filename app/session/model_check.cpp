// SPDX-License-Identifier: MIT
// How a model's solver holds answers against better ones, and what becomes of poor ones.
#include <algorithm>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

#include "app/session/model_solver.h"
#include "app/session/progress.h"
#include "geotherm/heat_method.h"
#include "solver/accuracy/candidates.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

/// Sources of many that are checked.
constexpr std::size_t kMaxSampled = 8;

/// Indices of at most kMaxSampled source sets, evenly spaced.
std::vector<std::size_t> spread(std::size_t count) {
  const std::size_t taken = std::min(count, kMaxSampled);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < taken; ++i) {
    numbers.push_back(taken == 1 ? 0 : i * (count - 1) / (taken - 1));
  }
  return numbers;
}

// What was checked, an answer or a method for many, is treated alike.
const AccuracyReport& report_on(const Answer& answer) { return *answer.error; }
const AccuracyReport& report_on(const CheckedMethod& checked) { return checked.error; }
Warning line_on(const Answer& answer) { return accuracy_line(*answer.error); }
Warning line_on(const CheckedMethod& checked) { return accuracy_line(checked.error); }
const MethodOptions& asked_of(const Answer& answer) { return answer.options; }
const MethodOptions& asked_of(const CheckedMethod& checked) { return checked.by.options; }

/// Warns of what is poor or could not be checked. Errors: kNumericalFailure (OnPoor::kFail).
template <class Checked>
Result<void> warn_or_fail(Checked& checked, OnPoor on_poor) {
  const AccuracyReport& report = report_on(checked);
  const Warning line = line_on(checked);
  if (on_poor == OnPoor::kFail) {
    if (auto right = refuse_poor(report, line); !right) return right;
  }
  if (auto warning = accuracy_warning(report, line)) {
    checked.warnings.push_back(*std::move(warning));
  }
  return {};
}

/// Tries better methods in order and puts the first that is not poor, else the last, in place of
/// what is poor, which stays with a warning where `kinds` is empty. `ask`: takes MethodOptions and
/// a progress. Errors: those of the first one, kCancelled.
template <class Checked, class Ask>
Result<void> replace_poor(Checked& poor, const std::vector<MethodKind>& kinds,
                          const Progress& progress, Ask&& ask) {
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, kinds.size()));
  std::optional<Checked> best;
  double done = 0;
  for (const MethodKind kind : kinds) {
    auto next = ask(better_options(asked_of(poor), kind), part_of(progress, done, done + share));
    if (!next && (!best || next.error().code == ErrorCode::kCancelled)) return next.error();
    if (!next) break;  // what was poor, too, is better than nothing
    best = *std::move(next);
    if (!report_on(*best).is_poor()) break;
    done += share;
  }
  if (!best) return warn_or_fail(poor, OnPoor::kBetter);
  std::ranges::copy(replaced_warnings(asked_of(poor).method, line_on(poor), asked_of(*best).method,
                                      report_on(*best), line_on(*best)),
                    std::back_inserter(best->warnings));
  best->replaced = std::move(poor.error);
  poor = *std::move(best);
  return {};
}

/// Looks for a remedy in a space: settings of heat where it is small enough, else its reference
/// method, which the answers were held against. Errors: kCancelled.
Result<void> find_in_space(const Space& space, const CheckedAnswers& answers,
                           const ReferenceAnswers& better, bool further, AccuracyReport& report,
                           const Progress& progress) {
  constexpr Index kMaxCells = 30'000, kMaxCellsFurther = 100'000;  // 3D factors grow quickly
  std::vector<Candidate> candidates;
  const HeatMethod* const heat = answers.method.heat();
  if (heat != nullptr && report.figures.differently_reached == 0 &&
      space.cell_count() <= (further ? kMaxCellsFurther : kMaxCells)) {
    candidates =
        space_candidates(answers.options, !space.boundary_vertices().empty(), heat->relative_t());
  }
  const auto make = [&](const MethodOptions& options, const Progress& part) {
    return build_method_sharing(space, options, &answers.method, part);
  };
  auto found = diagnose_space(make, answers, better, candidates, progress);
  if (!found) return found.error();
  tell_found(report, *std::move(found));
  return {};
}

}  // namespace

MethodKind ModelSolver::reference_of(MethodKind checked, const CheckSettings& settings) const {
  if (model_.space) return model_.space->reference_method();
  return reference_in(settings, checked, model_.mesh->face_count());
}

MethodKind ModelSolver::reference_of_better(MethodKind kind, Check check) const {
  return model_.space ? kind : app::reference_of_better(kind, check, model_.mesh->face_count());
}

bool ModelSolver::is_better(MethodKind a, MethodKind b) const {
  if (!model_.space) return geotherm::is_better(a, b);
  return a != b && a == model_.space->reference_method() &&
         (b == MethodKind::kHeat || geotherm::is_better(a, b));
}

std::vector<MethodKind> ModelSolver::better_methods(MethodKind poor, Check check) const {
  if (!model_.space) return app::better_methods(poor, check, model_.mesh->face_count());
  const MethodKind best = model_.space->reference_method();
  return is_better(best, poor) ? std::vector{best} : std::vector<MethodKind>();
}

Result<ReferenceAnswers> ModelSolver::reference(
    MethodKind kind, std::span<const SourceSet> sets, int threads, const Progress& progress,
    std::shared_ptr<const IntrinsicSurface> triangulation) {
  if (use_ == Use::kOneAnswer && !model_.space) {
    return geotherm::solve_reference(model_.mesh, kind, sets, threads, std::move(triangulation),
                                     progress);
  }
  const Stopwatch watch;
  MethodOptions options;
  options.method = kind;
  options.threads = threads;
  const auto made = make(options, nullptr, part_of(progress, 0.0, 0.3));
  if (!made) return made.error();
  auto solved = geotherm::solve_reference(**made, sets, part_of(progress, 0.3, 1.0));
  if (solved) solved->milliseconds = watch.milliseconds();
  return solved;
}

/// Computes reference distances into `reference_`.
Result<void> ModelSolver::solve_reference(MethodKind kind, const CheckedAnswers& answers,
                                          const DistanceMethod& triangulated_by,
                                          const Progress& progress) {
  const std::vector<SourceSet> sets(answers.sources.begin(), answers.sources.end());
  if (use_ == Use::kSession && reference_ && reference_->answers.method == kind &&
      reference_->sets == sets) {
    return {};
  }
  reference_.reset();
  const auto begun = std::exchange(beside_, nullptr);
  auto solved = begun && begun->has_begun()
                    ? begun->wait(progress)
                    : reference(kind, sets, answers.options.threads, progress,
                                triangulation_for_waves(triangulated_by));
  if (!solved) return solved.error();
  reference_ = Reference{sets, *std::move(solved)};
  return {};
}

/// The report on answers, without a search for a remedy. Errors: kCancelled.
Result<AccuracyReport> ModelSolver::compare_with(const CheckedAnswers& answers, MethodKind kind,
                                                 Check check, const DistanceMethod& triangulated_by,
                                                 const Progress& progress) {
  const MethodKind checked = answers.method.kind();
  if (!is_better(kind, checked)) {
    return unchecked(checked, check, model_.space != nullptr);
  }
  const auto solved = solve_reference(kind, answers, triangulated_by, progress);
  if (!solved && solved.error().code == ErrorCode::kCancelled) return solved.error();
  if (!solved) return failed_check(checked, solved.error());
  try {
    return hold_against(answers.distances, checked, reference_->answers);
  } catch (const std::bad_alloc&) {
    return failed_check(checked, {ErrorCode::kOutOfMemory, "the memory ended"});
  }
}

/// Looks for a remedy: in a thorough check also where the distances are fair, but not in a session,
/// where the next answer waits. Errors: kCancelled.
Result<void> ModelSolver::find_remedy(AccuracyReport& report, const CheckedAnswers& answers,
                                      Check check, const Progress& progress) try {
  if (!report.measured) return {};
  const bool further = is_thorough(check) && use_ == Use::kOneAnswer;
  if (model_.space) {
    const bool wanted = further ? report.grade >= Grade::kFair : report.is_poor();
    if (!wanted) return {};
    return find_in_space(*model_.space, answers, reference_->answers, further, report, progress);
  }
  return geotherm::find_remedy(report, model_.mesh, answers, reference_->answers,
                               further ? RemedySearch::kWhereNotGood : RemedySearch::kWherePoor,
                               progress);
} catch (const std::bad_alloc&) {
  return {};  // the figures stand without it
}

/// Searches a remedy, applies OnPoor, and stores the report in the answer. Errors:
/// kNumericalFailure (OnPoor::kFail), kCancelled.
Result<void> ModelSolver::settle(Answer& answer, AccuracyReport report,
                                 const CheckSettings& settings, const Progress& progress) {
  if (!settings.quick) {
    auto found = find_remedy(report, checked_answers(answer), settings.against,
                             with_prefix(progress, "finding the cause: "));
    if (!found) return found;
  }
  answer.error = std::make_shared<const AccuracyReport>(std::move(report));
  if (settings.quick) return {};
  const auto right = warn_or_fail(answer, settings.on_poor);
  return right ? right : about_model(model_.name, right.error());
}

Result<void> ModelSolver::check(Answer& answer, const CheckSettings& settings,
                                const Progress& progress) {
  const MethodKind kind = reference_of(answer.method->kind(), settings);
  if (settings.quick && !is_better(kind, answer.method->kind())) return {};
  auto report = compare_with(checked_answers(answer), kind, settings.against, *answer.method,
                             part_of(progress, 0.0, 0.6));
  if (!report) return report.error();
  return settle(answer, *std::move(report), settings, part_of(progress, 0.6, 1.0));
}

/// Answers by a better method in place of a poor one. Errors: those of its solve.
Result<void> ModelSolver::replace(Answer& answer, const ResolvedSources& sources,
                                  const Wanted& wanted, const Progress& progress) {
  const Check check = wanted.check.against;
  QueryOptions query = wanted.query;
  query.fields = false;
  const auto ask = [&](const MethodOptions& options, const Progress& part) -> Result<Answer> {
    const MethodKind against = reference_of_better(options.method, check);
    auto next = distances(options, sources, query, part_of(part, 0.0, 0.5));
    if (!next) return next;
    auto report = compare_with(checked_answers(*next), against, Check::kOn, *answer.method,
                               part_of(part, 0.5, 1.0));
    if (!report) return report.error();
    next->error = std::make_shared<const AccuracyReport>(*std::move(report));
    next->report_ms = answer.report_ms;
    describe_mesh(*next);
    return next;
  };
  return replace_poor(answer, better_methods(answer.options.method, check), progress, ask);
}

Result<CheckedMethod> ModelSolver::check_method(const ReadyMethod& ready,
                                                std::span<const SourceSet> all,
                                                const CheckSettings& settings,
                                                const Progress& progress) {
  const Progress checking = with_prefix(progress, "checking: ");
  const std::vector<std::size_t> numbers = spread(all.size());
  std::vector<SourceSet> sets;
  for (const std::size_t i : numbers) sets.push_back(all[i]);
  /// Asks `by` for the sample and holds that against the method `against`.
  const auto checked = [&](const ReadyMethod& by, MethodKind against, bool searches,
                           const Progress& part) -> Result<SampleCheck> {
    const MethodKind near_exact =
        model_.space ? model_.space->reference_method() : MethodKind::kWavefront;
    if (!is_better(near_exact, by.options.method) && searches) {
      const bool in_space = model_.space != nullptr;
      return SampleCheck{unchecked(by.options.method, settings.against, in_space), all.size()};
    }
    auto results = by.method->solve_each(sets, {.quality = false}, part_of(part, 0.0, 0.2));
    if (!results) return about_model(model_.name, results.error());
    std::vector<std::vector<double>> distances;
    for (DistanceResult& result : *results) distances.push_back(std::move(result.distances));
    const CheckedAnswers answers{*by.method, by.options, sets, distances};
    auto report =
        compare_with(answers, against, settings.against, *ready.method, part_of(part, 0.2, 0.5));
    if (!report) return report.error();
    if (searches && settings.on_poor != OnPoor::kBetter) {
      auto found = find_remedy(*report, answers, settings.against, part_of(part, 0.5, 1.0));
      if (!found) return found.error();
    }
    reference_.reset();
    report->worst_set = numbers[report->worst_set];
    return SampleCheck{*std::move(report), all.size()};
  };
  auto check = checked(ready, reference_of(ready.options.method, settings), true,
                       part_of(checking, 0.0, 0.5));
  if (!check) return check.error();
  CheckedMethod out{ready, *std::move(check), {}, {}};
  if (settings.on_poor != OnPoor::kBetter || !out.error.is_poor()) {
    const auto right = warn_or_fail(out, settings.on_poor);
    if (!right) return about_model(model_.name, right.error());
    return out;
  }
  const auto ask = [&](const MethodOptions& options,
                       const Progress& part) -> Result<CheckedMethod> {
    const MethodKind against = reference_of_better(options.method, settings.against);
    auto by = prepare(options, part_of(part, 0.0, 0.5));
    if (!by) return by.error();
    auto error = checked(*by, against, false, part_of(part, 0.5, 1.0));
    if (!error) return error.error();
    return CheckedMethod{*by, *std::move(error), {}, {}};
  };
  const auto kinds = better_methods(ready.options.method, settings.against);
  const auto done = replace_poor(out, kinds, part_of(checking, 0.5, 1.0), ask);
  if (!done) return done.error();
  return out;
}

}  // namespace geotherm::app
