// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/solve_bench.h"

namespace geotherm::bench {

/// How times grow with the number of vertices: time ~ vertices^exponent.
struct Exponents {
  double setup = kNotMeasured;
  double query = kNotMeasured;
};

struct Growth {
  std::string name;
  Exponents all, regular, irregular;  ///< over all meshes, and over those of one kind
};

/// Slopes of log time over log vertices (least squares), with an offset of its own for each kind of
/// mesh, so that a shape's own pace is no growth. One row for each contender that was measured on
/// two sizes of one kind. What cannot be said is not a number.
std::vector<Growth> measure_growth(const std::vector<SolveGroup>& groups);

}  // namespace geotherm::bench
