// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/distance_method.h"

namespace geotherm {

/// Whether the reach of a query is one on a mesh of so many vertices. Errors: kBadInput (a largest
/// distance that is not above 0, a target out of range, with its place).
Result<void> check_reach(const Reach& reach, Index vertices);

/// Of an answer for all vertices what is asked for: beyond the largest distance nothing, and with
/// targets or Reach::sparse a list. Precondition: check_reach(). Cost: O(V).
void keep_reach(const Reach& reach, DistanceResult& result);

}  // namespace geotherm
