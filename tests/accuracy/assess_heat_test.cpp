// SPDX-License-Identifier: MIT
#include "solver/accuracy/check_heat.h"

#include <gtest/gtest.h>

#include "solver/core/text.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

DistanceResult with_residuals(double heat, double poisson) {
  DistanceResult result;
  result.quality.heat_residual = heat;
  result.quality.poisson_residual = poisson;
  return result;
}

bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(Residuals, OfOrderOneAreFailuresWithTheNumberAndTheCure) {
  for (const double residual : {0.5, 7e14, kUnreached, kNan}) {
    for (DistanceResult result : {with_residuals(residual, 0), with_residuals(0, residual)}) {
      const auto large = assess_heat({}, 1e15, {}, result);
      ASSERT_FALSE(large) << residual;
      EXPECT_EQ(large.error().code, ErrorCode::kNumericalFailure);
      EXPECT_TRUE(says(sentence(large.error()), rounded_text(residual).c_str()));
      EXPECT_TRUE(says(sentence(large.error()), "smaller time-factor")) << large.error().message;
      const auto small = assess_heat({}, 1e-15, {}, result);
      ASSERT_FALSE(small) << residual;
      EXPECT_TRUE(says(sentence(small.error()), "larger time-factor")) << small.error().message;
      const auto usual = assess_heat({}, 1, {}, result);
      ASSERT_FALSE(usual) << residual;
      EXPECT_FALSE(says(sentence(usual.error()), "time")) << usual.error().message;
    }
  }
}

TEST(Residuals, ThatAreSmallButNotRoundOffAreAWarning) {
  DistanceResult result = with_residuals(2e-3, 1e-12);
  ASSERT_TRUE(assess_heat({}, 1, {}, result));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_TRUE(says(sentence(result.warnings[0]), "0.002")) << sentence(result.warnings[0]);
}

TEST(Residuals, OfThePenaltyModeAreAWarningWhileTheyAreNumbers) {
  HeatOptions options;
  options.constraint.mode = ConstraintMode::kPenalty;
  DistanceResult result = with_residuals(0, 0.4);
  EXPECT_TRUE(assess_heat(options, 1, {}, result));
  EXPECT_EQ(result.warnings.size(), 1U);
  DistanceResult none = with_residuals(0, kNan);
  EXPECT_FALSE(assess_heat(options, 1, {}, none));
  DistanceResult cold = with_residuals(0.4, 0);
  EXPECT_FALSE(assess_heat(options, 1, {}, cold)) << "the heat step has no penalty";
}

TEST(Slopes, ThatNoDistanceHasAreAWarningWithTheCure) {
  DistanceResult good, blurred;
  good.quality.eikonal_error_mean = 0.3;
  blurred.quality.eikonal_error_mean = 0.61;
  ASSERT_TRUE(assess_heat({}, 1000, {}, good));
  EXPECT_TRUE(good.warnings.empty());
  ASSERT_TRUE(assess_heat({}, 1000, {}, blurred));
  ASSERT_EQ(blurred.warnings.size(), 1U);
  for (const char* part : {"0.61", "1e+03", "smaller time-factor"}) {
    EXPECT_TRUE(says(sentence(blurred.warnings[0]), part)) << sentence(blurred.warnings[0]);
  }
}

TEST(Slopes, HaveACureThatHelpsWhereTheyAreWrong) {
  const auto cure = [](const HeatOptions& options, double unit_t, const CellCounts& cells,
                       const char* names) {
    DistanceResult result;
    result.quality.eikonal_error_mean = 0.9;
    EXPECT_TRUE(assess_heat(options, unit_t, cells, result, 0, names));
    return hint_text(result.warnings.back().hint);
  };
  EXPECT_EQ(cure({}, 1, {}, "faces"), "refine the mesh");
  EXPECT_EQ(cure({}, 1e-300, {}, "faces"), "raise time-factor");
  EXPECT_EQ(cure({}, 1, {}, "cells"), "use method wavefront") << "a grid cannot be refined";
  HeatOptions held;
  held.boundary = BoundaryRule::kDirichlet;
  EXPECT_TRUE(says(cure(held, 0.25, {100, 99}, "cells"), "boundary neumann"));
}

/// Distances that were raised to the straight line may be right.
TEST(BelowTheLine, WhatWasRaisedIsNotSaidToBeWrong) {
  DistanceResult raised;
  raised.quality.reached_vertices = 4;
  raised.quality.clamped_vertices = 1;
  raised.quality.below_straight_line = 1;
  raised.quality.most_below_straight_line = 0.4;
  raised.quality.lines_checked = true;
  DistanceResult kept = raised;
  ASSERT_TRUE(assess_heat({}, 1, {}, raised));
  ASSERT_EQ(raised.warnings.size(), 2U);
  for (const Warning& warning : raised.warnings) {
    EXPECT_FALSE(says(sentence(warning), "it is wrong")) << sentence(warning);
    EXPECT_FALSE(says(sentence(warning), "set to 0")) << sentence(warning);
    EXPECT_TRUE(says(sentence(warning), "straight line")) << sentence(warning);
  }
  EXPECT_TRUE(says(raised.warnings[1].message, "raised"));
  HeatOptions classic;  // does not raise
  classic.variant = Variant::kClassic;
  ASSERT_TRUE(assess_heat(classic, 1, {}, kept));
  EXPECT_TRUE(says(kept.warnings[0].message, "set to 0"));
  EXPECT_TRUE(says(kept.warnings[1].message, "it is wrong around there"));
}

}  // namespace
}  // namespace geotherm::test
