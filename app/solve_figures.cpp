// SPDX-License-Identifier: MIT
#include "app/solve_figures.h"

#include <algorithm>
#include <cmath>

namespace geotherm::app {

DistanceSummary summarize(std::span<const double> distances) {
  DistanceSummary summary;
  summary.min = kUnreached;
  double mean = 0;
  double reached = 0;
  for (const double d : distances) {
    if (!std::isfinite(d)) {
      ++summary.unreached;
      continue;
    }
    summary.min = std::min(summary.min, d);
    summary.max = std::max(summary.max, d);
    mean += (d - mean) / ++reached;  // a sum could leave the range of doubles
  }
  summary.mean = mean;
  return summary;
}

}  // namespace geotherm::app
