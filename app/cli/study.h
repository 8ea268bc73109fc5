// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/session/model.h"
#include "app/session/report.h"
#include "app/session/sweep.h"
#include "geotherm/build_method.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct StudyTask {
  MethodOptions options;  ///< of the heat method, but for what is swept
  SourceSet sources;
  std::vector<double> factors;  ///< m, ascending
  std::vector<BoundaryRule> boundaries;
  double mean_edge = 0;  ///< of a triangle mesh (MeshReport), model units
};

struct Study {
  std::vector<StudyRow> rows;  ///< by rule, factor, boundary, constraint
  MethodKind reference = MethodKind::kExact;
  double largest_distance = 0;  ///< of the reference, model units
  double mean_edge = 0;         ///< model units; of a space the mean width of its cells
};

/// The constraint modes that are swept, in the order of the rows.
std::vector<Constraint> study_constraints();

/// `count` (2 or more) factors from `least` to `most`, about the same ratio apart: those between
/// are rounded to as many digits as tell them apart.
std::vector<double> study_factors(double least, double most, int count);

/// Sweeps the time factor over both rules, all constraint modes and the boundary rules, each held
/// against the best method that fits the mesh (reference_for()), or is there in a space
/// (Space::reference_method()). What fails is a row with its failure. Cost: a heat factorisation
/// for each rule, factor and boundary rule, and a query for each row. Errors: those of the
/// reference; kCancelled.
Result<Study> study_of(const Model& model, const StudyTask& task, const Progress& progress = {});

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
