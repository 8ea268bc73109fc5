// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "solver/method/build_method.h"

namespace geotherm {

/// The one option of the heat method to which most of an error is due.
struct ErrorCause {
  std::string option;   ///< as on the command line, without dashes: "time-factor"
  std::string value;    ///< its cure: "1"
  std::string because;  ///< "t is too large (m = 100, sqrt(t) = 10 mean edges)"
  double mean_relative_before = 0, mean_relative_after = 0;  ///< DistanceError::mean_relative
};

struct Diagnosis {
  std::optional<ErrorCause> cause;  ///< absent: no change lowers the error by much
  bool skipped = false;             ///< nothing was tried: the mesh has too many faces
  bool refined = false;             ///< more faces were tried as well; else they were too many, or
                                    ///< there was no need
};

/// Meshes with more faces are not solved again to find a cause, nor refined beyond that.
inline constexpr Index kMostFacesDiagnosed = 300'000;

/// A mean relative error of the heat method that needs no explanation.
inline constexpr double kGoodError = 0.02;

/// Why an answer of the heat method is wrong, by counterfactual: solves again with one option at a
/// time set to what is recommended, of those that are not, and names the one that lowers the mean
/// relative error most. Where none brings it to kGoodError, MethodOptions::refine + 1 is tried as
/// well, and named if it leaves less than half of what the best of them leaves. Only what takes
/// more than a fifth of the error away is a cause. Options whose solve fails are none. `distances`:
/// the answer of `options`, whose HeatMethod::relative_t() is given; `better`: those of the
/// reference. Preconditions: options.method is kHeat; both spans have one number a vertex. Errors:
/// kCancelled. Cost: a set-up and a query for each option tried, at most nine.
Result<Diagnosis> diagnose(const std::shared_ptr<const TriangleMesh>& mesh,
                           const MethodOptions& options, double relative_t,
                           const SourceSet& sources, std::span<const double> distances,
                           std::span<const double> better, const Progress& progress = {});

}  // namespace geotherm
