// SPDX-License-Identifier: MIT
#include "app/picture/picture_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace geotherm::test {
namespace {

using app::make_ticks;
using app::nearest_round_number;
using app::round_number_above;
using app::round_spacing;
using app::Ticks;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Labels = std::vector<std::string>;

TEST(RoundNumbers, AreOneTwoTwoAndAHalfOrFiveTimesAPowerOfTen) {
  EXPECT_EQ(nearest_round_number(1.04), 1);
  EXPECT_EQ(nearest_round_number(1.6), 2);
  EXPECT_EQ(nearest_round_number(0.024), 0.025);
  EXPECT_EQ(nearest_round_number(0.037), 0.05);
  EXPECT_EQ(nearest_round_number(8e5), 1e6);
  EXPECT_EQ(round_number_above(2.0), 2);
  EXPECT_EQ(round_number_above(2.1), 2.5);
  EXPECT_EQ(round_number_above(5.1), 10);
  EXPECT_EQ(round_number_above(1e-30), 1e-30);
}

TEST(RoundSpacing, GivesAboutTwentyIsolinesOverAnyRange) {
  for (double range = 1e-30; range < 1e30; range *= 1.7) {
    const double count = range / round_spacing(range);
    EXPECT_GE(count, 14) << range;
    EXPECT_LE(count, 29) << range;
  }
}

TEST(RoundSpacing, OfNoRangeIsANumberAllTheSame) {
  for (const double range : {0.0, -1.0, std::nan(""), kInfinite, 5e-324, 1.7e308}) {
    const double spacing = round_spacing(range);
    EXPECT_TRUE(std::isfinite(spacing) && spacing > 0) << range << " has " << spacing;
  }
}

TEST(Ticks, AreRoundAndOnIsolinesWhereTheyCanBeBoth) {
  for (const double spacing : {0.1, 0.2, 0.25, 0.5}) {
    const double step = make_ticks(0, 25 * spacing, 7, spacing).step;
    EXPECT_EQ(step, nearest_round_number(step)) << spacing;
    EXPECT_NEAR(step / spacing, std::round(step / spacing), 1e-9) << spacing;
  }
}

TEST(TickLabels, HaveTheSameNumberOfDecimalsAndAPlainZero) {
  EXPECT_EQ(make_ticks(0, 1.6, 5).labels, (Labels{"0", "0.5", "1.0", "1.5"}));
  EXPECT_EQ(make_ticks(0, 10, 6).labels, (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(make_ticks(-1, 1, 5).labels, (Labels{"-1.0", "-0.5", "0", "0.5", "1.0"}));
  EXPECT_EQ(make_ticks(0, 2.4e5, 3).labels, (Labels{"0", "100000", "200000"}));
}

TEST(TickLabels, OfLargeAndSmallNumbersShareAPowerOfTen) {
  EXPECT_EQ(make_ticks(0, 1.6e-30, 5).labels, (Labels{"0", "0.5e-30", "1.0e-30", "1.5e-30"}));
  EXPECT_EQ(make_ticks(0, 3e30, 4).labels, (Labels{"0", "1e30", "2e30", "3e30"}));
  EXPECT_EQ(make_ticks(0, 3e-300, 4).labels, (Labels{"0", "1e-300", "2e-300", "3e-300"}));
  EXPECT_EQ(make_ticks(0, 3e300, 4).labels, (Labels{"0", "1e300", "2e300", "3e300"}));
}

TEST(Ticks, AreFewDistinctAndWithinTheRangeWhateverItIs) {
  constexpr int kMax = 7;
  for (double width = 1e-30; width < 1e30; width *= 3.1) {
    for (const double min : {0.0, -width / 3, width, -7.7 * width}) {
      const Ticks ticks = make_ticks(min, min + width, kMax);
      ASSERT_GE(ticks.values.size(), 2U) << min << " " << width;
      ASSERT_LE(ticks.values.size(), static_cast<std::size_t>(kMax)) << min << " " << width;
      const double slack = 1e-5 * width;
      EXPECT_GE(ticks.values.front(), min - slack);
      EXPECT_LE(ticks.values.back(), min + width + slack);
      const std::set<std::string> labels(ticks.labels.begin(), ticks.labels.end());
      EXPECT_EQ(labels.size(), ticks.values.size()) << ticks.labels.front();
      for (std::size_t i = 0; i < ticks.values.size(); ++i) {
        EXPECT_NEAR(std::stod(ticks.labels[i]), ticks.values[i], slack) << ticks.labels[i];
      }
    }
  }
}

TEST(Ticks, LieOnIsolines) {
  EXPECT_EQ(make_ticks(0, 1, 7, 0.3).labels, (Labels{"0", "0.3", "0.6", "0.9"}));
  EXPECT_EQ(make_ticks(0, 1, 5, 0.05).labels, (Labels{"0", "0.25", "0.50", "0.75", "1.00"}));
}

TEST(Ticks, AreRoundWhereIsolinesAreTooFewOrTooMany) {
  EXPECT_EQ(make_ticks(0, 10, 6, 9e9).labels.size(), 6U);
  EXPECT_EQ(make_ticks(0, 10, 6, 1e-9).labels.size(), 6U);
}

TEST(Ticks, OfNoRangeAreNone) {
  EXPECT_TRUE(make_ticks(1, 1, 5).values.empty());
  EXPECT_TRUE(make_ticks(2, 1, 5).values.empty());
  EXPECT_TRUE(make_ticks(0, kInfinite, 5).values.empty());
  EXPECT_TRUE(make_ticks(0, std::nan(""), 5).values.empty());
}

TEST(Ticks, OfARangeAtTheLimitOfDoublesEndTheirSearch) {
  const double next = std::nextafter(1e9, 2e9);
  EXPECT_LE(make_ticks(1e9, next, 7).values.size(), 7U);
  EXPECT_LE(make_ticks(0, 5e-324, 7).values.size(), 7U);
}

}  // namespace
}  // namespace geotherm::test
