// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "solver/core/types.h"

namespace geotherm {

inline constexpr Index kSmallGraph = 64;

/// Exact minimum-degree order of a graph of up to 64 vertices, one bit mask of neighbours each
/// (destroyed). Writes local vertex numbers in order of elimination. Source: Rose 1972.
inline void minimum_degree_order(std::span<std::uint64_t> adjacency, std::span<Index> order) {
  const std::size_t n = adjacency.size();
  std::uint64_t alive = n == 64 ? ~0ULL : (1ULL << n) - 1;
  for (std::size_t step = 0; step < n; ++step) {
    int best = -1;
    int best_degree = 65;
    for (std::uint64_t rest = alive; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      const int degree = std::popcount(adjacency[v]);
      if (degree < best_degree) {
        best = v;
        best_degree = degree;
      }
    }
    order[step] = best;
    const std::uint64_t bit = 1ULL << best;
    alive &= ~bit;
    const std::uint64_t clique = adjacency[best];
    for (std::uint64_t rest = clique; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      adjacency[v] = (adjacency[v] | clique) & ~bit & ~(1ULL << v);
    }
  }
}

}  // namespace geotherm
