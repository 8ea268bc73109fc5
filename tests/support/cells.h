// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "geotherm/geotherm.h"
#include "tests/support/solve.h"

namespace geotherm::test {

using CellsPtr = std::shared_ptr<const CellComplex>;

inline CellsPtr shared(Result<CellComplex> cells) {
  EXPECT_TRUE(cells) << (cells ? "" : cells.error().message);
  return cells ? std::make_shared<const CellComplex>(*std::move(cells)) : nullptr;
}

inline DistanceResult solve_cells(const CellsPtr& cells, const SourceSet& sources,
                                  const HeatOptions& options = {}) {
  return solve(method_of(cells, options), sources);
}

/// Mean of |d - |x - x_s|| over the mean distance.
inline double straight_error(const CellComplex& cells, const std::vector<double>& distances,
                             Vec3 source) {
  double error = 0, sum = 0;
  for (std::size_t v = 0; v < distances.size(); ++v) {
    const double line = (cells.positions[v] - source).norm();
    error += std::abs(distances[v] - line);
    sum += line;
  }
  return error / sum;
}

}  // namespace geotherm::test
