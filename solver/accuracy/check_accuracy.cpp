// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <cmath>
#include <new>
#include <utility>

#include "solver/accuracy/candidates.h"
#include "solver/core/stopwatch.h"
#include "solver/core/text.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {
namespace {

constexpr int kBins = 41;

/// Whether the mean error decides the grade, else the largest.
bool mean_decides(const DistanceError& error) {
  return error.mean_relative > (grade_of(error) == Grade::kPoor ? kFairError : kGoodError);
}

/// The figure that decides the grade of `wrong`, of these figures.
std::string figure_text(const DistanceError& wrong, double mean_relative, double max_of_range) {
  if (mean_decides(wrong)) return percent_text(mean_relative);
  return "up to " + percent_text(max_of_range) + " of the largest distance";
}

double badness_of(const TriedSetting& tried) {
  DistanceError error;
  error.mean_relative = tried.mean_relative;
  error.max_of_range = tried.max_of_range;
  return badness(error);
}

/// What the answer of a method that others are held against is known to be.
std::string near_exactness_of(MethodKind reference) {
  switch (reference) {
    case MethodKind::kExact:
      return "exact";
    case MethodKind::kWavefront:
    case MethodKind::kWavefrontFine:
      return "near exact";
    case MethodKind::kHeat:
    case MethodKind::kFastMarching:
      break;
  }
  return "what it was held against";
}

/// Appends ", with SETTING it is FIGURE".
void add_gain(const AccuracyReport& report, const TriedSetting& tried, Hint& advice) {
  std::string gain = " it is ";
  if (tried.option == "method" && tried.value == to_text(tried.against)) {
    gain += near_exactness_of(tried.against);
  } else {
    gain += figure_text(report.figures, tried.mean_relative, tried.max_of_range);
    if (tried.against != report.reference) gain += " (against " + to_text(tried.against) + ')';
  }
  advice.insert(advice.end(), {advice.empty() ? "with " : ", with ", setting_of(tried), gain});
}

/// What was found to help.
Hint advice_of(const AccuracyReport& report) {
  const TriedSetting *best = nullptr, *cause = nullptr;
  for (const TriedSetting& tried : report.tried) {
    if (best == nullptr || badness_of(tried) < badness_of(*best)) best = &tried;
    const bool is_cause =
        report.cause && tried.option == report.cause->option && tried.value == report.cause->value;
    if (is_cause) cause = &tried;
  }
  if (best == nullptr || badness_of(*best) >= badness(report.figures)) {
    return {"the " + to_text(report.reference) + " method, which it was held against, is nearer"};
  }
  Hint advice;
  if (cause != nullptr && badness_of(*cause) > badness_of(*best)) {
    add_gain(report, *cause, advice);
  }
  add_gain(report, *best, advice);
  if (!report.remedy) advice.emplace_back(", the best of what was tried");
  return advice;
}

/// Where a share of the vertices is reached by one method alone, figures say nothing.
std::string reach_text(const DistanceError& error) {
  const auto count = static_cast<std::size_t>(error.differently_reached);
  return counted_text(count, "vertex is", "vertices are") +
         " reached by one method and not by the other";
}

Error memory_ended(MethodKind kind) {
  return {ErrorCode::kOutOfMemory,
          "the memory ended in the check by the method " + to_text(kind),
          {"take a mesh with fewer faces"}};
}

}  // namespace

std::string percent_text(double share) {
  const double percent = 100 * share;
  constexpr double kWhole = 99.5;  // from here on two digits are fewer than those before the point
  if (percent >= kWhole && percent < 1e6) return std::to_string(std::llround(percent)) + " %";
  return rounded_text(percent, 2) + " %";
}

Result<ReferenceAnswers> solve_reference(const std::shared_ptr<const TriangleMesh>& mesh,
                                         MethodKind kind, std::span<const SourceSet> sources,
                                         int threads,
                                         std::shared_ptr<const IntrinsicSurface> triangulation,
                                         const Progress& progress) try {
  constexpr double kSetUpShare = 0.3;
  MethodOptions options;
  options.method = kind;
  options.threads = threads;
  const Stopwatch watch;
  std::shared_ptr<const WaveSurface> waves;
  if (triangulation && walks_on_inserted(kind)) {
    auto shared =
        build_wave_surface(std::move(triangulation), part_of(progress, 0.0, kSetUpShare / 2));
    if (!shared) return shared.error();
    waves = *std::move(shared);
  }
  const auto method = build_method(mesh, options, part_of(progress, 0.0, kSetUpShare), waves);
  if (!method) return method.error();
  auto answers = solve_reference(**method, sources, part_of(progress, kSetUpShare, 1.0));
  if (answers) answers->milliseconds = watch.milliseconds();
  return answers;
} catch (const std::bad_alloc&) {
  return memory_ended(kind);
}

Result<ReferenceAnswers> solve_reference(const DistanceMethod& method,
                                         std::span<const SourceSet> sources,
                                         const Progress& progress) try {
  const Stopwatch watch;
  auto results = method.solve_each(sources, {.quality = false}, progress);
  if (!results) return results.error();
  ReferenceAnswers answers;
  answers.method = method.kind();
  for (DistanceResult& result : *results) answers.distances.push_back(std::move(result.distances));
  answers.milliseconds = watch.milliseconds();
  return answers;
} catch (const std::bad_alloc&) {
  return memory_ended(method.kind());
}

AccuracyReport hold_against(std::span<const std::vector<double>> distances, MethodKind checked,
                            const ReferenceAnswers& better) {
  AccuracyReport report;
  report.reference = better.method;
  report.sets = distances.size();
  report.milliseconds = better.milliseconds;
  const JointError joint = joint_error(distances, better.distances);
  report.figures = joint.figures;
  report.worst_set = joint.worst_set;
  if (report.figures.worst == kNoIndex) {
    report.reference = checked;
    report.verdict = "no vertex has both distances";
    return report;
  }
  report.measured = true;
  report.grade = grade_of(report.figures);
  report.verdict = to_text(report.grade);
  if (report.figures.differently_reached > 0) {
    report.reason = ": " + reach_text(report.figures);
  }
  if (distances.size() == 1) {
    report.values = signed_error(distances.front(), better.distances.front());
    report.histogram = error_histogram(report.values, kBins);
  }
  return report;
}

std::string sentence(const AccuracyReport& report, std::string_view before_name) {
  return sentence(report.verdict + report.reason, report.advice, before_name);
}

AccuracyReport unmeasured(MethodKind method, std::string verdict) {
  AccuracyReport report;
  report.reference = method;
  report.verdict = std::move(verdict);
  return report;
}

Result<void> find_remedy(AccuracyReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                         const CheckedAnswers& answers, const ReferenceAnswers& better,
                         RemedySearch search, const Progress& progress) try {
  if (!report.measured || search == RemedySearch::kNever) return {};
  const bool wanted = search == RemedySearch::kWherePoor ? report.grade == Grade::kPoor
                                                         : report.grade >= Grade::kFair;
  if (!wanted || report.figures.differently_reached > 0) return {};
  auto found = diagnose(mesh, answers, better.method, better.distances,
                        search == RemedySearch::kWherePoor ? kMaxFacesBesides : kMaxFacesDiagnosed,
                        progress);
  if (!found && found.error().code == ErrorCode::kOutOfMemory) return {};
  if (!found) return found.error();
  tell_found(report, *std::move(found));
  return {};
} catch (const std::bad_alloc&) {
  return {};  // the figures stand without it
}

void tell_found(AccuracyReport& report, Diagnosis found) {
  report.cause = std::move(found.cause);
  report.remedy = std::move(found.remedy);
  report.tried = std::move(found.tried);
  if (report.cause && !report.cause->because.empty()) {
    report.reason = " because " + report.cause->because;
  }
  report.advice = advice_of(report);
  report.verdict =
      to_text(report.grade) + ": " +
      figure_text(report.figures, report.figures.mean_relative, report.figures.max_of_range);
}

Result<AccuracyReport> check_accuracy(const std::shared_ptr<const TriangleMesh>& mesh,
                                      const CheckedAnswers& answers, const AccuracyOptions& options,
                                      const Progress& progress) try {
  const MethodKind checked = answers.method.kind();
  const MethodKind reference =
      options.reference.value_or(usual_reference(checked, mesh->face_count()));
  if (!is_better(reference, checked)) {
    return unmeasured(
        checked, checked == MethodKind::kExact
                     ? "this is the most accurate method there is"
                     : "the method " + to_text(checked) + " was not held against a better one");
  }
  const bool searches = options.search != RemedySearch::kNever;
  auto better = solve_reference(mesh, reference, answers.sources, options.threads,
                                triangulation_for_waves(answers.method),
                                part_of(progress, 0.0, searches ? 0.3 : 1.0));
  if (!better) return better.error();
  AccuracyReport report = hold_against(answers.distances, checked, *better);
  if (auto found =
          find_remedy(report, mesh, answers, *better, options.search, part_of(progress, 0.3, 1.0));
      !found) {
    return found.error();
  }
  return report;
} catch (const std::bad_alloc&) {
  return memory_ended(answers.method.kind());
}

}  // namespace geotherm
