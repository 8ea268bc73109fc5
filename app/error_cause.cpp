// SPDX-License-Identifier: MIT
#include "app/error_cause.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "app/text.h"

namespace geotherm::app {
namespace {

/// What helps where no option does.
std::string way_out(const Diagnosis& diagnosis, const MethodOptions& options, Index faces) {
  if (diagnosis.skipped) {
    return "no cause was looked for in " + counted(faces, "face", "faces") +
           "; the method wavefront is nearer";
  }
  if (diagnosis.refined) {
    return "neither another option nor more faces lower it much; the method wavefront is nearer";
  }
  const std::int64_t refined = std::int64_t{faces} << (2 * (options.refine + 1));
  return "no other option lowers it much; --refine " + std::to_string(options.refine + 1) +
         " was not tried, for its " + grouped(refined) + " faces are more than " +
         grouped(kMostFacesDiagnosed) + "; try it or --method wavefront-fine";
}

}  // namespace

bool needs_cause(const ErrorReport& report, MethodKind checked) {
  return checked == MethodKind::kHeat && report.figures.worst != kNoIndex &&
         report.figures.differently_reached == 0 && report.figures.mean_relative > kGoodError;
}

Result<void> find_cause(ErrorReport& report, const std::shared_ptr<const TriangleMesh>& mesh,
                        const MethodOptions& options, double relative_t, const SourceSet& sources,
                        std::span<const double> distances, const Progress& progress) {
  std::vector<double> better(distances.begin(), distances.end());
  for (std::size_t v = 0; v < better.size(); ++v) better[v] -= report.values[v];
  for (double& d : better) d = std::isfinite(d) ? d : kUnreached;
  auto diagnosis = diagnose(mesh, options, relative_t, sources, distances, better, progress);
  if (!diagnosis) return diagnosis.error();
  const std::string error =
      grade(report.figures.mean_relative) + ": " + percent(report.figures.mean_relative);
  if (!diagnosis->cause) {
    report.verdict = error + "; " + way_out(*diagnosis, options, mesh->face_count());
    return {};
  }
  const ErrorCause& cause = *diagnosis->cause;
  report.verdict = error + " because " + cause.because + "; with --" + cause.option + ' ' +
                   cause.value + " it is " + percent(cause.mean_relative_after);
  report.cause = *std::move(diagnosis->cause);
  report.cause->mean_relative_before = report.figures.mean_relative;
  return {};
}

}  // namespace geotherm::app
