// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/distance_method.h"
#include "geotherm/error.h"
#include "geotherm/options.h"
#include "solver/heat/quality.h"

namespace geotherm {

/// Whether a diffusion time, in squares of the mean edge, may be why a system could not be solved.
bool is_extreme_time(double unit_t);

/// A kNumericalFailure or kBudgetEnded of the heat step with what to do about the diffusion time
/// added, where that is extreme.
/// `unit_t`: t in squares of the mean edge.
Error with_time_cure(Error error, double unit_t, TimeRule rule);

/// Appends to an answer what a person should know about its quality figures, which must be filled
/// in. Errors: kNumericalFailure where residuals say
/// that this is no answer at all.
Result<void> judge(const HeatOptions& options, double unit_t, const FaceCounts& faces,
                   DistanceResult& result);

}  // namespace geotherm
