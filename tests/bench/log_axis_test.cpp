// SPDX-License-Identifier: MIT
#include "app/picture/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace geotherm::test {
namespace {

using app::chart::LogAxis;

TEST(LogAxis, HasSomeTicksWithinTheAxisWhateverTheRange) {
  for (double low = 1e-7; low < 1e7; low *= 3.7) {
    for (double ratio = 1; ratio < 1e7; ratio *= 2.3) {
      LogAxis axis(300, 20);
      axis.include(low);
      axis.include(low * ratio);
      axis.round_outwards();
      const std::vector<double> ticks = axis.ticks();
      EXPECT_GE(ticks.size(), 3u) << low << " x" << ratio;
      EXPECT_LE(ticks.size(), 10u) << low << " x" << ratio;
      EXPECT_TRUE(std::ranges::is_sorted(ticks));
      for (const double tick : ticks) {
        EXPECT_GE(axis.at(tick), 20 - 1e-3) << tick;
        EXPECT_LE(axis.at(tick), 300 + 1e-3) << tick;
      }
      EXPECT_LE(axis.at(low), 300 + 1e-3);
      EXPECT_GE(axis.at(low * ratio), 20 - 1e-3);
    }
  }
}

TEST(LogAxis, EqualRatiosAreEqualLengths) {
  LogAxis axis(0, 100);
  axis.include(1);
  axis.include(1e4);
  EXPECT_NEAR(axis.at(10), 25, 1e-9);
  EXPECT_NEAR(axis.at(100), 50, 1e-9);
}

TEST(LogAxis, OneValueHasAPlace) {
  LogAxis axis(0, 100);
  axis.include(42);
  axis.pad(0.05);
  EXPECT_NEAR(axis.at(42), 50, 1e-9);
}

TEST(LogAxis, LeavesOutWhatHasNoLogarithm) {
  LogAxis axis(0, 100);
  for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    axis.include(value);
  }
  EXPECT_TRUE(axis.empty());
  axis.round_outwards();
  EXPECT_TRUE(axis.ticks().empty());
}

}  // namespace
}  // namespace geotherm::test
