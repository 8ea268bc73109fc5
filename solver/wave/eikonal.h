// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "solver/method/distance_bounds.h"

namespace geotherm {

/// Mean of | |grad d| - 1 | by area, over the faces whose corners are all reached; 0 where there is
/// none; edges that are too steep are counted. `distances`: V, in the units of the mesh. Cost:
/// O(F).
double eikonal_error_mean(const IntrinsicMesh& mesh, std::span<const double> distances,
                          SteepSides& steep);

}  // namespace geotherm
