// SPDX-License-Identifier: MIT
#include "bench/estimates.h"

#include <gtest/gtest.h>

#include "tests/bench/bench_fixture.h"

namespace geotherm::test {
namespace {

using bench::Estimate;
using bench::Estimates;
using bench::reason_not_to_run;

constexpr double kExact = 1e-9;

TEST(Estimates, ContinueThePowerOfTwoSizes) {
  Estimates estimates;
  for (const Index faces : {30'000, 100'000}) {
    estimates.learn(faces, figures_of("x", faces, 1, 1.4));
  }
  const auto estimate = estimates.of("x", 400'000);
  ASSERT_TRUE(estimate);
  const bench::Figures truth = figures_of("x", 400'000, 1, 1.4);
  EXPECT_NEAR(estimate->setup_ms / truth.setup_ms, 1, kExact);
  EXPECT_NEAR(estimate->query_ms / truth.query_ms, 1, kExact);
  EXPECT_NEAR(estimate->peak_mb / truth.peak_mb, 1, kExact);
}

TEST(Estimates, DoNotBelieveSlopesOfNoise) {
  Estimates estimates;
  estimates.learn(30'000, figures_of("x", 30'000, 100, 1));  // one slow small mesh
  estimates.learn(100'000, figures_of("x", 100'000, 1, 1));
  const auto estimate = estimates.of("x", 1'000'000);
  ASSERT_TRUE(estimate);
  EXPECT_GE(estimate->setup_ms, 10 * figures_of("x", 100'000, 1, 1).setup_ms * (1 - kExact));
}

TEST(Estimates, AreEmptyForWhatIsNotKnown) {
  Estimates estimates;
  EXPECT_FALSE(estimates.of("x", 1000));
  estimates.learn(1000, {.name = "x"});  // nothing was measured
  EXPECT_FALSE(estimates.of("x", 1000));
}

TEST(Estimates, OneSizeIsEnoughForAGuess) {
  Estimates estimates;
  estimates.learn(30'000, figures_of("x", 30'000, 1, 1));
  const auto estimate = estimates.of("x", 300'000);
  ASSERT_TRUE(estimate);
  EXPECT_GT(estimate->setup_ms, 10 * figures_of("x", 30'000, 1, 1).setup_ms);
}

TEST(LeftOut, IsWhatIsTooSlowWithTheNumbers) {
  const Estimate slow{.setup_ms = 120'000, .query_ms = 2000, .peak_mb = 10};
  const bench::Limits limits{.most_ms = 60'000, .most_memory_mb = 100};
  const std::string reason = reason_not_to_run(slow, limits, false);
  EXPECT_NE(reason.find("120 s"), std::string::npos) << reason;
  EXPECT_NE(reason.find("60.0 s"), std::string::npos) << reason;
  EXPECT_EQ(reason_not_to_run(slow, limits, true), "");
}

TEST(LeftOut, IsWhatIsSlowInItsQueriesAlone) {
  const Estimate slow{.setup_ms = 1, .query_ms = 59'000, .peak_mb = 10};
  EXPECT_NE(reason_not_to_run(slow, {.most_ms = 60'000, .most_memory_mb = 100}, false), "");
}

TEST(LeftOut, IsWhatIsTooLargeHoweverPatientOneIs) {
  const Estimate large{.setup_ms = 1, .query_ms = 1, .peak_mb = 4096};
  const bench::Limits limits{.most_ms = 60'000, .most_memory_mb = 2048};
  const std::string reason = reason_not_to_run(large, limits, true);
  EXPECT_NE(reason.find("4.00 GB"), std::string::npos) << reason;
  EXPECT_NE(reason.find("2.00 GB"), std::string::npos) << reason;
}

TEST(LeftOut, IsNothingThatFits) {
  const Estimate fits{.setup_ms = 1000, .query_ms = 100, .peak_mb = 100};
  EXPECT_EQ(reason_not_to_run(fits, {.most_ms = 60'000, .most_memory_mb = 2048}, false), "");
}

}  // namespace
}  // namespace geotherm::test
