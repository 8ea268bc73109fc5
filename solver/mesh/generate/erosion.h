// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace geotherm::generate {

/// A square grid of heights: `side` x `side` values, row by row, `step` apart.
struct HeightGrid {
  int side;
  double step;
  std::vector<double> heights;

  double& at(int column, int row) { return heights[index(column, row)]; }
  double at(int column, int row) const { return heights[index(column, row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(column);
  }
  /// Catmull-Rom interpolation at grid coordinates, which are clamped to the grid.
  double interpolate(double column, double row) const;
};

/// Rivers at work: `rounds` times the ground rises by `uplift` (per point), and rivers, which
/// follow the steepest descent, cut it: dh/dt = uplift - rate sqrt(drained area) slope, solved
/// implicitly from the mouths upwards (Braun & Willett 2013). The border keeps its height; hollows
/// are filled before, so that all of the ground drains to it. Slopes slide to at most `steepest`.
/// Cost: O(side^2) per round.
void erode(HeightGrid& grid, const std::vector<double>& uplift, double rate, double steepest,
           int rounds);

}  // namespace geotherm::generate
