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
  return percent(e.mean_relative) + " on average, at most " + percent(e.max_of_range) +
         " of the largest distance, at vertex " + std::to_string(e.worst);
}

/// Why a method is not held against another one.
std::string not_asked(MethodKind kind, CheckMode mode) {
  if (kind == MethodKind::kExact) return "this is the most accurate method there is";
  if (mode == CheckMode::kThorough) return "nothing more accurate fits a mesh of this size";
  return to_text(kind) + " is near exact; --check measures how near";
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

MethodKind reference_in(const CheckSettings& settings, MethodKind checked, Index faces) {
  if (settings.against) return *settings.against;
  return settings.mode == CheckMode::kThorough ? reference_for(checked, faces)
                                               : usual_reference(checked, faces);
}

AccuracyReport failed_check(MethodKind method, const Error& error) {
  AccuracyReport report = unmeasured(method, "the distances were not checked: " + told(error));
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

std::vector<std::string> replaced_warnings(MethodKind poor, const std::string& poor_line,
                                           MethodKind by, const AccuracyReport& report,
                                           const std::string& line) {
  std::vector<std::string> warnings = {"the method " + to_text(by) + " answered, for the method " +
                                       to_text(poor) + " gave poor distances: " + poor_line};
  if (report.is_poor()) {
    warnings.push_back("the method " + to_text(by) +
                       ", which answered, gave poor distances: " + line);
  } else if (report.failed) {
    warnings.push_back(told(report));
  }
  return warnings;
}

std::string error_title(const AccuracyReport& report) {
  return "error, against " + to_text(report.reference);
}

std::string percent(double share) { return percent_text(share); }

}  // namespace geotherm::app
