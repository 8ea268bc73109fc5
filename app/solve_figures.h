// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/load_model.h"
#include "solver/geometry/mesh_report.h"
#include "solver/heat/heat_method.h"

namespace geotherm::app {

struct DistanceSummary {
  double min = 0, max = 0, mean = 0;  ///< over the vertices that are reached, model units
  Index unreached = 0;
};
DistanceSummary summarize(std::span<const double> distances);

/// All there is to say about one solve.
struct SolveFigures {
  Model model;
  MeshReport mesh;
  HeatMethod method;
  SourceSet sources;
  DistanceResult result;
  DistanceSummary distance;
  double peak_rss_mb = 0;
  std::vector<std::string> warnings;
};

}  // namespace geotherm::app
