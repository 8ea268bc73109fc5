// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geotherm/types.h"

namespace geotherm {

/// Puts points together that are joined by steps of at most `distance` from point to point.
///
/// Returns for each point the lowest number of its group. Preconditions: finite points, distance
/// >= 0 (0: equal points, where -0 is 0). The answer does not depend on the order in which pairs
/// are looked at. Cost: O(n log n) where groups are small beside the whole, or few.
std::vector<Index> merge_close(std::span<const Vec3> points, double distance);

}  // namespace geotherm
