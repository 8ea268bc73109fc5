// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/distance_method.h"

namespace geotherm {

/// Whether the reach of a query is one on a mesh of so many vertices. Errors: kBadInput (a largest
/// distance that is not above 0, a target out of range, with its place).
Result<void> check_reach(const Reach& reach, Index vertices);

/// Cuts an answer for all vertices down to what is asked for: nothing beyond the largest distance,
/// and a list with targets or Reach::sparse. Precondition: check_reach(). Cost: O(V).
void keep_reach(const Reach& reach, DistanceResult& result);

}  // namespace geotherm
