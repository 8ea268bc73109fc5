// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/heat/linear_system.h"

namespace geotherm {

/// u for K source sets, with an exponent of its own where doubles do not reach: the value at row i
/// of column c is u(i, c) * step^level[i * K + c]. `level` is empty when every level is 0.
struct HeatField {
  using Level = std::uint16_t;
  Block u;
  std::vector<Level> level;
  double step = 1.0;
  int iterations = 0;
};

/// How far below a column's largest entry its entries can be trusted: far down for a direct
/// solver, which keeps relative accuracy entry by entry on these matrices, but for terms that have
/// underflowed, 2e-308; not so for an iterative one, which converges in norm.
inline constexpr double kDirectFloor = 1e-295;
inline constexpr double kIterativeFloor = 1e-7;

/// The size below which entries are solved again, where the largest is `largest`. Underflow does
/// not ask how large the others are: whatever the solver, no entry below kDirectFloor is kept.
inline double least_trusted(double floor, double largest) {
  return std::max(floor * largest, kDirectFloor);
}

/// Diffuses: solves M u = b (b n x K, its nonzero rows listed in `support`) so that every entry in
/// the reached components is right relative to itself, however small.
///
/// Where u falls below the floor, the values beyond are solved again: u restricted to the far side
/// and one layer before it satisfies M w = r with r on the interface alone; r is scaled up by
/// 1 / floor and solved with the same factor, and so on outwards.
///
/// reached: per column, a flag per component. `progress` is asked before every solve, and by an
/// iterative backend within. Errors: the factorisation's, kCancelled.
Result<HeatField> diffuse(const LinearSystem& system, const Components& components, Block b,
                          std::span<const Index> support,
                          const std::vector<std::vector<char>>& reached, double floor,
                          const Workspace& work, const Progress& progress = {});

/// The mean of two fields.
HeatField average(HeatField a, const HeatField& b);

}  // namespace geotherm
