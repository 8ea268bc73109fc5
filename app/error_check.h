// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/method/build_method.h"
#include "solver/method/distance_error.h"
#include "solver/quality/diagnose.h"

// How wrong distances are, by a more accurate method.
namespace geotherm::app {

struct ErrorReport {
  MethodKind reference = MethodKind::kExact;  ///< the method itself: there is nothing better
  DistanceError figures;
  ErrorHistogram histogram;              ///< of the values
  std::vector<double> values;            ///< V: d - d_reference; infinite where either is
  std::string verdict;                   ///< in words
  double milliseconds = 0;               ///< that the reference took, set-up and query
  std::optional<ErrorCause> cause = {};  ///< where one was looked for and found (find_cause())
};

/// Holds distances of `checked` against those of a better method.
ErrorReport error_report(std::span<const double> distances, MethodKind reference,
                         std::span<const double> better, MethodKind checked, double milliseconds);

/// What is to be said where there is nothing better to hold the method against; no values.
ErrorReport unchecked(MethodKind checked);

/// Solves with the more accurate method that fits the mesh (reference_for()). Errors: those of
/// build_method() and its queries.
Result<ErrorReport> check_error(const std::shared_ptr<const TriangleMesh>& mesh, MethodKind checked,
                                std::span<const double> distances, const SourceSet& sources,
                                int threads, const Progress& progress);

/// What the values are, over a colour bar: "error against exact".
std::string error_title(const ErrorReport& report);

/// "near exact", "good", "fair" or "poor".
std::string grade(double mean_relative);

/// "0.81 %".
std::string percent(double share);

}  // namespace geotherm::app
