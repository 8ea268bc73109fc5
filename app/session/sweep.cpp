// SPDX-License-Identifier: MIT
#include "app/session/sweep.h"

#include <algorithm>
#include <string_view>

#include "geotherm/heat_method.h"

namespace geotherm::app {

Result<void> sweep(ModelSolver& solver, const SourceSet& sources,
                   std::span<const MethodOptions> steps, std::span<const double> better,
                   const std::function<bool(const StudyRow& row)>& take, const Progress& progress) {
  const ResolvedSources placed{sources, {}};
  const double range = summarize(better).max;
  double done = 0;
  const Progress swept = [&](std::string_view, double share) {
    return report(progress, "sweep",
                  (done + std::clamp(share, 0.0, 1.0)) / static_cast<double>(steps.size()));
  };
  for (const MethodOptions& options : steps) {
    StudyRow row;
    row.rule = options.time_step.rule;
    row.factor = options.time_step.factor;
    row.boundary = options.boundary;
    row.constraint = options.constraint.mode;
    const auto answer = solver.solve(options, placed, {{.quality = false}}, swept);
    if (!answer) {
      if (answer.error().code == ErrorCode::kCancelled) return answer.error();
      row.failure = answer.error();
    } else {
      row.t = answer->method->heat()->t();
      row.unit_t = answer->method->heat()->relative_t();
      const DistanceError error = distance_error(answer->result.distances, better);
      if (error.worst != kNoIndex) {
        row.mean_error = error.mean_relative;
        row.max_error = error.max_of_range;
        if (range > 0) row.source_distance = answer->result.quality.max_source_distance / range;
      }
    }
    if (!take(row)) break;
    ++done;
  }
  return {};
}

}  // namespace geotherm::app
