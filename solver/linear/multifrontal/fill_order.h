// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
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

inline constexpr Index kSmallGraph = 64;

/// Neighbours of a vertex of a small graph, a bit each: those that are ordered with it, and those
/// beyond, which are eliminated later.
struct NeighborMask {
  std::uint64_t inner = 0, halo = 0;

  int count() const { return std::popcount(inner) + std::popcount(halo); }
};

/// Exact minimum-degree order of a graph of up to 64 vertices (its neighbours are destroyed).
/// Neighbours in the halo count, since eliminating a vertex joins them too. Writes local vertex
/// numbers in order of elimination. Sources: Rose 1972; the halo: Pellegrini, Roman, Amestoy 2000.
void minimum_degree_order(std::span<NeighborMask> neighbors, std::span<Index> order);

}  // namespace geotherm
