// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/core/result.h"
#include "solver/geometry/fem_operator.h"
#include "solver/heat/surface.h"

namespace geotherm {

/// The diffusion times of a surface's components: h and A/F of a rule are those of each.
struct DiffusionTimes {
  PerComponent t = 0;         ///< in units of the intrinsic mesh squared
  PerComponent relative = 0;  ///< in squares of the component's own mean edge
  double model_t = 0;         ///< of the component with most faces, model units squared
  double relative_t = 0;      ///< of the same, in squares of its mean edge
  double grading = 1;         ///< of the same, Refinement::grading
  double extreme = 1;         ///< that member of `relative` whose logarithm is farthest from 0

  bool operator==(const DiffusionTimes&) const = default;
};

/// Precondition: the step's factor, or its absolute time, is positive and finite. Errors:
/// kBadInput (a time that is 0 or not finite in squares of the mean edge).
Result<DiffusionTimes> diffusion_times(const Surface& surface, const TimeStep& step);

/// The share c of the mass that is consistent, FemOperator: half where the mesh resolves the
/// diffusion length, none for Variant::kClassic.
PerComponent consistent_share(Variant variant, const PerComponent& relative_t);

}  // namespace geotherm
