// SPDX-License-Identifier: MIT
#include "app/error_check.h"

#include <cmath>

#include "app/text.h"
#include "solver/core/stopwatch.h"

namespace geotherm::app {
namespace {

/// Bounds of the mean relative error: beside the heat method's usual 0.5 to 2 %, less is near exact
/// and more has a cause worth looking for.
constexpr double kNearExact = 1e-3, kGood = kGoodError, kFair = 0.05;

constexpr int kBins = 41;

std::string cure(MethodKind checked) {
  if (checked != MethodKind::kHeat) return "the method wavefront is nearer";
  return "try another time factor, or the method wavefront";
}

std::string verdict_of(MethodKind checked, const DistanceError& e) {
  if (e.worst == kNoIndex) return "no vertex has both distances";
  if (e.differently_reached > 0) {
    return counted(e.differently_reached, "vertex is", "vertices are") +
           " reached by one method and not by the other";
  }
  const std::string word = grade(e.mean_relative);
  return e.mean_relative <= kGood ? word : word + ": " + cure(checked);
}

}  // namespace

std::string grade(double mean_relative) {
  if (mean_relative <= kNearExact) return "near exact";
  if (mean_relative <= kGood) return "good";
  return mean_relative <= kFair ? "fair" : "poor";
}

std::string error_title(const ErrorReport& report) {
  return "error, against " + to_text(report.reference);
}

std::string percent(double share) { return significant(100 * share, 2) + " %"; }

ErrorReport error_report(std::span<const double> distances, MethodKind reference,
                         std::span<const double> better, MethodKind checked, double milliseconds) {
  ErrorReport report;
  report.reference = reference;
  report.figures = distance_error(distances, better);
  report.values = signed_error(distances, better);
  report.histogram = error_histogram(report.values, kBins);
  report.verdict = verdict_of(checked, report.figures);
  report.milliseconds = milliseconds;
  return report;
}

ErrorReport unchecked(MethodKind checked) {
  ErrorReport report;
  report.reference = checked;
  report.verdict = checked == MethodKind::kExact ? "this is the most accurate method there is"
                                                 : "nothing more accurate fits a mesh of this size";
  return report;
}

Result<ErrorReport> check_error(const std::shared_ptr<const TriangleMesh>& mesh, MethodKind checked,
                                std::span<const double> distances, const SourceSet& sources,
                                int threads, const Progress& progress) {
  MethodOptions options;
  options.method = reference_for(checked, mesh->face_count());
  options.threads = threads;
  if (!is_better(options.method, checked)) return unchecked(checked);
  const Stopwatch watch;
  const auto method = build_method(mesh, options, part_of(progress, 0.0, 0.1));
  if (!method) return method.error();
  const auto better = (*method)->solve(sources, {.quality = false}, part_of(progress, 0.1, 1.0));
  if (!better) return better.error();
  return error_report(distances, options.method, better->distances, checked, watch.milliseconds());
}

}  // namespace geotherm::app
