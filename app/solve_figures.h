// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/answer_check.h"
#include "app/load_model.h"
#include "geotherm/build_method.h"
#include "geotherm/mesh_report.h"

namespace geotherm::app {

struct DistanceSummary {
  double min = 0, max = 0, mean = 0;  ///< over the vertices that are reached, model units
  Index unreached = 0;
};
DistanceSummary summarize(std::span<const double> distances);

/// All there is to say about one solve.
struct SolveFigures {
  Model model;
  MeshSummary mesh;
  std::shared_ptr<const DistanceMethod> method;
  MethodOptions options;
  SourceSet sources;
  DistanceResult result;
  DistanceSummary distance;
  double peak_rss_mb = 0;
  std::vector<std::string> warnings;
  std::optional<AccuracyReport> error = {};     ///< none: it was not to be checked
  std::optional<AccuracyReport> replaced = {};  ///< of the poor answer that this one stands for
  double report_ms = 0;  ///< of what is said about the mesh, where it was timed
};

}  // namespace geotherm::app
