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

/// A fill-reducing elimination order from vertex positions: order[k] is the vertex eliminated
/// k-th. Each part is cut by find_separator(); parts of up to 64 vertices are ordered by minimum
/// degree, with what surrounds them. Nested dissection: George 1973; from geometry: Heath, Raghavan
/// 1995.
///
/// Positions: one point a vertex, any unit. The result does not depend on `threads`.
/// Cost: O(n log n); on surfaces about an eighth of a graph partitioner's time, for a factor of
/// about its size.
std::vector<Index> nested_dissection(const SymmetricPattern& pattern,
                                     std::span<const Vec3> positions, int threads);

}  // namespace geotherm
