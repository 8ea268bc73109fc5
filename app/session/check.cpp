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
  return percent_text(e.mean_relative) + " on average, at most " + percent_text(e.max_of_range) +
         " of the largest distance, at vertex " + std::to_string(e.worst);
}

/// ", against exact: poor because ...".
std::string graded(const AccuracyReport& report) {
  return ", against " + to_text(report.reference) + ": " + to_text(report.grade) + report.reason;
}

}  // namespace

AccuracyReport unchecked(MethodKind method, Check check, bool in_space) {
  if (method == MethodKind::kExact) {
    return unmeasured(method, "this is the most accurate method there is");
  }
  if (in_space && is_better(MethodKind::kWavefront, method)) {
    return unmeasured(method,
                      to_text(method) + (method == MethodKind::kHeat
                                             ? " is the only method here"
                                             : " is the reference here, and nothing is better"));
  }
  if (in_space) {
    AccuracyReport report = unmeasured(method, to_text(method) + " is near exact");
    report.advice = {SettingHint{"method", {to_text(MethodKind::kExact)}}, " is exact"};
    return report;
  }
  if (is_thorough(check)) {
    return unmeasured(method, "nothing more accurate fits a mesh of this size");
  }
  AccuracyReport report = unmeasured(method, to_text(method) + " is near exact");
  report.advice = {SettingHint{"check"}, " measures how near"};
  return report;
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
  Warning said = warning_of(error);
  AccuracyReport report = unmeasured(method, "the distances were not checked: " + said.message);
  report.advice = std::move(said.hint);
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

Warning accuracy_line(const AccuracyReport& report) {
  if (!report.measured) return {report.verdict + report.reason, report.advice};
  return {figures_in_words(report.figures) + graded(report), report.advice};
}

Warning accuracy_line(const SampleCheck& check) {
  const AccuracyReport& report = check;
  if (!report.measured) return accuracy_line(report);
  return {"on " + grouped(static_cast<std::int64_t>(report.sets)) + " of " +
              counted(static_cast<std::int64_t>(check.of), "source", "sources") + ": " +
              figures_in_words(report.figures) + " from source " +
              std::to_string(report.worst_set) + graded(report),
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
