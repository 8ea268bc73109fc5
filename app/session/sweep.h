// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "app/session/model_solver.h"

namespace geotherm::app {

/// The heat method with one choice of time, boundary rule and constraint. What could not be had is
/// empty.
struct StudyRow {
  TimeRule rule = TimeRule::kMeanEdge;
  double factor = 1;  ///< m
  double t = 0;       ///< model units squared
  double unit_t = 0;  ///< t / h^2, h the mean edge length of the component that t is of
  BoundaryRule boundary = BoundaryRule::kNeumann;
  ConstraintMode constraint = ConstraintMode::kPinSources;
  std::optional<double> mean_error;       ///< mean of |d - e| / e
  std::optional<double> max_error;        ///< largest |d - e| as a share of the largest e
  std::optional<double> source_distance;  ///< largest |d| on a source, as a share of the largest e
  std::optional<Error> failure;           ///< why something is missing
};

/// Answers with each of `steps`, options of the heat method, and holds it against `better` (V). The
/// solver makes each method from the last one, so that what stays the same is shared. `take`: told
/// each row when it is there; false ends the sweep. What fails is a row with its failure. The only
/// error: kCancelled.
Result<void> sweep(ModelSolver& solver, const SourceSet& sources,
                   std::span<const MethodOptions> steps, std::span<const double> better,
                   const std::function<bool(const StudyRow& row)>& take,
                   const Progress& progress = {});

}  // namespace geotherm::app
