// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "solver/linear/symmetric_pattern.h"

namespace geotherm {

/// An elimination order that keeps a Cholesky factor of this pattern sparse: order[k] is the
/// vertex eliminated k-th. Nested dissection by geometry where there are positions (n of them)
/// and the graph is large enough for it to pay, approximate minimum degree otherwise
/// (Amestoy, Davis, Duff 1996).
std::vector<Index> fill_reducing_order(const SymmetricPattern& pattern,
                                       std::span<const Vec3> positions, int threads);

/// Below this many vertices minimum degree is as good and nested dissection has nothing to split.
inline constexpr Index kDissectFrom = 2000;

}  // namespace geotherm
