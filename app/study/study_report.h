// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/report_json.h"
#include "app/study/study_run.h"

namespace geotherm::app {

/// The mean error over m for each rule and boundary rule with the default constraint, the other
/// constraints at the best m, and what is best.
std::string study_table(const std::string& model, const Study& study);

/// {"model", "sources", "reference", "largest_distance", "mean_edge_length", "best", "rows"}.
Json study_json(const std::string& model, const SourceSet& sources, const Study& study);

/// The error as curves on logarithmic axes: over m for both rules, over t / h^2, and over m for the
/// constraint modes. A picture that needs nothing else.
std::string study_svg(const std::string& model, const Study& study);

/// The row with the smallest mean error; null where there is none.
const StudyRow* best_row(const Study& study);

}  // namespace geotherm::app
