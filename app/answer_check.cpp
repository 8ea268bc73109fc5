// SPDX-License-Identifier: MIT
#include "app/answer_check.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "app/text.h"
#include "app/told.h"

namespace geotherm::app {
namespace {

/// Sources of many that are checked.
constexpr std::size_t kMaxSampled = 8;

std::vector<std::size_t> spread(std::size_t count) {
  const std::size_t taken = std::min(count, kMaxSampled);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < taken; ++i) {
    numbers.push_back(taken == 1 ? 0 : i * (count - 1) / (taken - 1));
  }
  return numbers;
}

std::string figures_in_words(const DistanceError& e) {
  return percent(e.mean_relative) + " on average, at most " + percent(e.max_of_range) +
         " of the largest distance, at vertex " + std::to_string(e.worst);
}

/// Why a method is not held against another one.
std::string not_asked(MethodKind kind, CheckMode mode) {
  if (kind == MethodKind::kExact) return "this is the most accurate method there is";
  if (mode == CheckMode::kThorough) return "nothing more accurate fits a mesh of this size";
  return to_text(kind) + " is near exact; --check measures how near";
}

AccuracyReport failed_check(MethodKind kind, const Error& error) {
  AccuracyReport report = unmeasured(kind, "the distances were not checked: " + told(error));
  report.failed = true;
  return report;
}

RemedySearch search_of(CheckMode mode) {
  switch (mode) {
    case CheckMode::kThorough:
      return RemedySearch::kWhereNotGood;
    case CheckMode::kUsual:
      return RemedySearch::kWherePoor;
    case CheckMode::kNone:
      break;
  }
  return RemedySearch::kNever;
}

}  // namespace

Result<void> refuse_better(const CheckSettings& settings, const std::string& what) {
  if (settings.on_poor != OnPoor::kBetter) return {};
  return Error{ErrorCode::kBadInput, "--on-poor better may answer by another method, and " + what +
                                         " is about the heat u; leave one of them out"};
}

AccuracyReport unchecked(MethodKind method, CheckMode mode) {
  return unmeasured(method, not_asked(method, mode));
}

Result<AccuracyReport> check_answers(const std::shared_ptr<const TriangleMesh>& mesh,
                                     const CheckedAnswers& answers, CheckMode mode,
                                     ReferenceAnswers& better, const Progress& progress) {
  const MethodKind checked = answers.method.kind();
  const Index faces = mesh->face_count();
  const MethodKind reference = mode == CheckMode::kThorough ? reference_for(checked, faces)
                                                            : usual_reference(checked, faces);
  if (!is_better(reference, checked)) return unchecked(checked, mode);
  return check_against(mesh, answers, reference, answers.method, better, progress);
}

Result<AccuracyReport> check_against(const std::shared_ptr<const TriangleMesh>& mesh,
                                     const CheckedAnswers& answers, MethodKind reference,
                                     const DistanceMethod& beside, ReferenceAnswers& better,
                                     const Progress& progress) {
  const MethodKind checked = answers.method.kind();
  if (!is_better(reference, checked)) return unchecked(checked, CheckMode::kUsual);
  auto solved =
      solve_reference(mesh, reference, answers.sources, answers.options.threads, &beside, progress);
  if (!solved && solved.error().code == ErrorCode::kCancelled) return solved.error();
  if (!solved) return failed_check(checked, solved.error());
  better = *std::move(solved);
  try {
    return hold_against(answers.distances, checked, better);
  } catch (const std::bad_alloc&) {
    return failed_check(checked, {ErrorCode::kOutOfMemory, "the memory ended"});
  }
}

Result<void> find_remedy(AccuracyReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                         const CheckedAnswers& answers, const ReferenceAnswers& better,
                         CheckMode mode, const Progress& progress) try {
  return geotherm::find_remedy(report, mesh, answers, better, search_of(mode), progress);
} catch (const std::bad_alloc&) {
  return {};  // the figures stand without it
}

MethodKind judge_of_better(MethodKind kind, CheckMode mode, Index faces) {
  if (faces <= kMaxFacesExact) return MethodKind::kExact;
  if (mode == CheckMode::kThorough) return reference_for(kind, faces);
  return kind == MethodKind::kWavefront ? MethodKind::kWavefrontFine : kind;
}

std::vector<MethodKind> better_methods(MethodKind poor, CheckMode mode, Index faces) {
  std::vector<MethodKind> kinds = {MethodKind::kWavefront, MethodKind::kWavefrontFine};
  const MethodKind judge = judge_of_better(MethodKind::kWavefrontFine, mode, faces);
  if (judge == MethodKind::kExact) kinds.push_back(judge);
  std::erase_if(kinds, [poor](MethodKind kind) { return !is_better(kind, poor); });
  return kinds;
}

MethodOptions better_options(const MethodOptions& options, MethodKind kind) {
  MethodOptions better;
  better.method = kind;
  better.threads = options.threads;
  return better;
}

namespace {

/// Some of many source sets, and what a method gives for them.
struct Sample {
  std::vector<std::size_t> numbers;
  std::vector<SourceSet> sets;
  std::vector<std::vector<double>> distances;
};

Result<Sample> take_sample(const DistanceMethod& method, std::span<const SourceSet> sets,
                           const Progress& progress) {
  Sample sample{spread(sets.size()), {}, {}};
  for (const std::size_t i : sample.numbers) sample.sets.push_back(sets[i]);
  auto results = method.solve_each(sample.sets, {.quality = false}, progress);
  if (!results) return results.error();
  for (DistanceResult& result : *results) sample.distances.push_back(std::move(result.distances));
  return sample;
}

SampleCheck sample_check(AccuracyReport report, const Sample& sample, std::size_t all) {
  const std::size_t worst = sample.numbers[report.worst_set];
  return {std::move(report), all, worst};
}

/// Shares of the progress: what is checked is solved for, and checked.
constexpr double kSolved = 0.2, kChecked = 0.5;

}  // namespace

Result<SampleCheck> check_sample(const std::shared_ptr<const TriangleMesh>& mesh,
                                 const DistanceMethod& method, const MethodOptions& options,
                                 std::span<const SourceSet> sets, CheckMode mode, bool search,
                                 const Progress& progress) {
  if (!is_better(MethodKind::kWavefront, method.kind())) {
    return SampleCheck{unchecked(method.kind(), mode), sets.size(), 0};
  }
  const auto sample = take_sample(method, sets, part_of(progress, 0.0, kSolved));
  if (!sample) return sample.error();
  const CheckedAnswers answers{method, options, sample->sets, sample->distances};
  ReferenceAnswers better;
  auto report = check_answers(mesh, answers, mode, better, part_of(progress, kSolved, kChecked));
  if (!report) return report.error();
  if (search) {
    const auto found =
        find_remedy(*report, mesh, answers, better, mode, part_of(progress, kChecked, 1.0));
    if (!found) return found.error();
  }
  return sample_check(*std::move(report), *sample, sets.size());
}

Result<SampleCheck> check_sample_against(const std::shared_ptr<const TriangleMesh>& mesh,
                                         const DistanceMethod& method, const MethodOptions& options,
                                         std::span<const SourceSet> sets, MethodKind reference,
                                         const DistanceMethod& beside, const Progress& progress) {
  const auto sample = take_sample(method, sets, part_of(progress, 0.0, kSolved));
  if (!sample) return sample.error();
  ReferenceAnswers better;
  auto report = check_against(mesh, {method, options, sample->sets, sample->distances}, reference,
                              beside, better, part_of(progress, kSolved, 1.0));
  if (!report) return report.error();
  return sample_check(*std::move(report), *sample, sets.size());
}

std::string accuracy_line(const AccuracyReport& report) {
  if (!report.measured) return told(report);
  return figures_in_words(report.figures) + ", against " + to_text(report.reference) + ": " +
         to_text(report.grade) + told(report.advice);
}

std::string accuracy_line(const SampleCheck& check) {
  const AccuracyReport& report = check.report;
  if (!report.measured) return told(report);
  return "on " + grouped(static_cast<std::int64_t>(report.sets)) + " of " +
         counted(static_cast<std::int64_t>(check.of), "source", "sources") + ": " +
         figures_in_words(report.figures) + " from source " + std::to_string(check.worst) +
         ", against " + to_text(report.reference) + ": " + to_text(report.grade) +
         told(report.advice);
}

std::string accuracy_warning(const AccuracyReport& report, const std::string& line) {
  if (report.is_poor()) return "poor distances: " + line;
  return report.failed ? told(report) : std::string();
}

Result<void> refuse_poor(const AccuracyReport& report, const std::string& line) {
  if (report.is_poor()) {
    return Error{ErrorCode::kNumericalFailure, "poor distances: " + line};
  }
  if (!report.failed) return {};
  return Error{ErrorCode::kNumericalFailure, told(report) + "; leave --on-poor fail out"};
}

std::string replaced_note(const MethodOptions& asked, const MethodOptions& answered,
                          const std::string& line) {
  return "the method " + to_text(answered.method) + " answered, for the method " +
         to_text(asked.method) + " gave poor distances: " + line;
}

std::string still_poor_warning(const AccuracyReport& report, const MethodOptions& answered,
                               const std::string& line) {
  if (!report.is_poor()) return report.failed ? told(report) : std::string();
  return "the method " + to_text(answered.method) +
         ", which answered, gave poor distances: " + line;
}

std::string error_title(const AccuracyReport& report) {
  return "error, against " + to_text(report.reference);
}

std::string percent(double share) { return percent_text(share); }

}  // namespace geotherm::app
