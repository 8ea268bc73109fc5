// SPDX-License-Identifier: MIT
#include "app/session/check.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

std::string figures_in_words(const DistanceError& e) {
  return percent(e.mean_relative) + " on average, at most " + percent(e.max_of_range) +
         " of the largest distance, at vertex " + std::to_string(e.worst);
}

/// Why a method is not held against another one.
std::string not_asked(MethodKind kind, Check check) {
  if (kind == MethodKind::kExact) return "this is the most accurate method there is";
  if (is_thorough(check)) return "nothing more accurate fits a mesh of this size";
  return to_text(kind) + " is near exact; --check measures how near";
}

}  // namespace

Result<void> refuse_better(const CheckSettings& settings, const std::string& what) {
  if (settings.on_poor != OnPoor::kBetter) return {};
  return Error{ErrorCode::kBadInput, "--on-poor better may answer by another method, and " + what +
                                         " is about the heat u; leave one of them out"};
}

AccuracyReport unchecked(MethodKind method, Check check) {
  return unmeasured(method, not_asked(method, check));
}

MethodKind reference_in(const CheckSettings& settings, MethodKind checked, Index faces) {
  // While a source is dragged exact distances must take no longer than a frame or two.
  constexpr Index kMaxFacesDragged = 10'000;
  switch (settings.against) {
    case Check::kOff:
    case Check::kOn:
      return usual_reference(checked, faces);
    case Check::kAuto:
      if (settings.quick && faces > kMaxFacesDragged) return MethodKind::kWavefrontFine;
      return reference_for(checked, faces);
    case Check::kWavefrontFine:
      return MethodKind::kWavefrontFine;
    case Check::kExact:
      break;
  }
  return MethodKind::kExact;
}

AccuracyReport failed_check(MethodKind method, const Error& error) {
  AccuracyReport report = unmeasured(method, "the distances were not checked: " + told(error));
  report.failed = true;
  return report;
}

MethodKind reference_of_better(MethodKind kind, Check check, Index faces) {
  if (faces <= kMaxFacesExact) return MethodKind::kExact;
  if (is_thorough(check)) return reference_for(kind, faces);
  return kind == MethodKind::kWavefront ? MethodKind::kWavefrontFine : kind;
}

std::vector<MethodKind> better_methods(MethodKind poor, Check check, Index faces) {
  std::vector<MethodKind> kinds = {MethodKind::kWavefront, MethodKind::kWavefrontFine};
  const MethodKind reference = reference_of_better(MethodKind::kWavefrontFine, check, faces);
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
