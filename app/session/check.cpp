// SPDX-License-Identifier: MIT
#include "app/session/check.h"

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "app/session/text.h"
#include "app/session/wording.h"

namespace geotherm::app {
namespace {

std::string figures_in_words(const DistanceError& e) {
  return percent_text(e.mean_relative) + " on average, at most " + percent_text(e.max_of_range) +
         " of the largest distance, at vertex " + std::to_string(e.worst);
}

/// ", against exact: poor because ...".
std::string graded(const AccuracyReport& report) {
  return ", against " + to_text(report.reference) + ": " + to_text(report.grade) + report.reason;
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

AccuracyReport unchecked(MethodKind method, CheckMode mode) {
  if (method == MethodKind::kExact) {
    return unmeasured(method, "this is the most accurate method there is");
  }
  if (mode == CheckMode::kThorough) {
    return unmeasured(method, "nothing more accurate fits a mesh of this size");
  }
  AccuracyReport report = unmeasured(method, to_text(method) + " is near exact");
  report.advice = {SettingHint{"check"}, " measures how near"};
  return report;
}

MethodKind reference_in(const CheckSettings& settings, MethodKind checked, Index faces) {
  if (settings.against) return *settings.against;
  return settings.mode == CheckMode::kThorough ? reference_for(checked, faces)
                                               : usual_reference(checked, faces);
}

AccuracyReport failed_check(MethodKind method, const Error& error) {
  Warning said = warning_of(error);
  AccuracyReport report = unmeasured(method, "the distances were not checked: " + said.message);
  report.advice = std::move(said.hint);
  report.failed = true;
  return report;
}

Result<void> find_remedy(AccuracyReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                         const CheckedAnswers& answers, const ReferenceAnswers& better,
                         CheckMode mode, const Progress& progress) try {
  return geotherm::find_remedy(report, mesh, answers, better, search_of(mode), progress);
} catch (const std::bad_alloc&) {
  return {};  // the figures stand without it
}

MethodKind reference_of_better(MethodKind kind, CheckMode mode, Index faces) {
  if (faces <= kMaxFacesExact) return MethodKind::kExact;
  if (mode == CheckMode::kThorough) return reference_for(kind, faces);
  return kind == MethodKind::kWavefront ? MethodKind::kWavefrontFine : kind;
}

std::vector<MethodKind> better_methods(MethodKind poor, CheckMode mode, Index faces) {
  std::vector<MethodKind> kinds = {MethodKind::kWavefront, MethodKind::kWavefrontFine};
  const MethodKind reference = reference_of_better(MethodKind::kWavefrontFine, mode, faces);
  if (reference == MethodKind::kExact) kinds.push_back(reference);
  std::erase_if(kinds, [poor](MethodKind kind) { return !is_better(kind, poor); });
  return kinds;
}

MethodOptions better_options(const MethodOptions& options, MethodKind kind) {
  MethodOptions better;
  better.method = kind;
  better.threads = options.threads;
  return better;
}

Warning accuracy_line(const AccuracyReport& report) {
  if (!report.measured) return {report.verdict + report.reason, report.advice};
  return {figures_in_words(report.figures) + graded(report), report.advice};
}

Warning accuracy_line(const SampleCheck& check) {
  const AccuracyReport& report = check.report;
  if (!report.measured) return accuracy_line(report);
  return {"on " + grouped(static_cast<std::int64_t>(report.sets)) + " of " +
              counted(static_cast<std::int64_t>(check.of), "source", "sources") + ": " +
              figures_in_words(report.figures) + " from source " + std::to_string(check.worst) +
              graded(report),
          report.advice};
}

std::optional<Warning> accuracy_warning(const AccuracyReport& report, const Warning& line) {
  if (report.is_poor()) return Warning{"poor distances: " + line.message, line.hint};
  if (report.failed) return line;
  return {};
}

Result<void> refuse_poor(const AccuracyReport& report, const Warning& line) {
  auto warning = accuracy_warning(report, line);
  if (!warning) return {};
  Error error{ErrorCode::kNumericalFailure, std::move(warning->message), std::move(warning->hint)};
  if (report.failed) {
    error.hint.insert(error.hint.end(), {error.hint.empty() ? "leave " : "; leave ",
                                         SettingHint{"on-poor"}, " fail out"});
  }
  return error;
}

std::vector<Warning> replaced_warnings(MethodKind poor, const Warning& poor_line, MethodKind by,
                                       const AccuracyReport& report, const Warning& line) {
  std::vector<Warning> warnings = {{"the method " + to_text(by) + " answered, for the method " +
                                        to_text(poor) +
                                        " gave poor distances: " + poor_line.message,
                                    poor_line.hint}};
  if (report.is_poor()) {
    warnings.push_back(
        {"the method " + to_text(by) + ", which answered, gave poor distances: " + line.message,
         line.hint});
  } else if (report.failed) {
    warnings.push_back(line);
  }
  return warnings;
}

std::string error_title(const AccuracyReport& report) {
  return "error, against " + to_text(report.reference);
}

}  // namespace geotherm::app
