// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "solver/core/types.h"

namespace geotherm {

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
inline void minimum_degree_order(std::span<NeighborMask> neighbors, std::span<Index> order) {
  const std::size_t n = neighbors.size();
  std::array<int, kSmallGraph> degree{};
  for (std::size_t v = 0; v < n; ++v) degree[v] = neighbors[v].count();
  std::uint64_t alive = n == 64 ? ~0ULL : (1ULL << n) - 1;
  for (std::size_t step = 0; step < n; ++step) {
    int best = std::countr_zero(alive);
    for (std::uint64_t rest = alive; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      if (degree[v] < degree[best]) best = v;
    }
    order[step] = best;
    const std::uint64_t bit = 1ULL << best;
    alive &= ~bit;
    const NeighborMask clique = neighbors[best];
    for (std::uint64_t rest = clique.inner; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      neighbors[v].inner = (neighbors[v].inner | clique.inner) & ~bit & ~(1ULL << v);
      neighbors[v].halo |= clique.halo;
      degree[v] = neighbors[v].count();
    }
  }
}

}  // namespace geotherm
