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

}  // namespace
}  // namespace geotherm::test
