// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bench/machine_limits.h"

namespace geotherm::test {
namespace {

using bench::MachineLimits;

constexpr InstructionSet kSets[] = {InstructionSet::kPlain, InstructionSet::kAvx2,
                                    InstructionSet::kAvx512};

TEST(MachineLimits, AreAboveZeroWithOneAndWithSeveralThreads) {
  const MachineLimits limits = bench::measure_limits(2, 2.4e7, [](std::string_view) {});
  ASSERT_TRUE(limits.measured());
  EXPECT_GT(limits.one_gflops, 0);
  EXPECT_GT(limits.all_gflops, 0);
  EXPECT_FALSE(limits.one_dgemm_gflops <= 0);  // or not a number, without a BLAS
  EXPECT_TRUE(std::isfinite(limits.one_gflops) && std::isfinite(limits.all_gflops));
  double last = 0;
  for (const MachineLimits::Reading& reading : limits.reading) {
    EXPECT_GT(reading.bytes, last);
    EXPECT_TRUE(reading.one_gbs > 0 && std::isfinite(reading.one_gbs));
    EXPECT_TRUE(reading.all_gbs > 0 && std::isfinite(reading.all_gbs));
    last = reading.bytes;
  }
  EXPECT_NEAR(last / 2.4e7, 1, 0.1);  // whole pages of 2 MB
}

TEST(MachineLimits, AreTheBetterOfTwoMeasurements) {
  MachineLimits best{.threads = 1, .reading = {{4e6, 1e9, 1e9}, {8.0 * (1 << 21), 0, 0}}};
  best.one_gflops = 1e9;  // nothing is that fast
  best.all_gflops = 0;
  const MachineLimits again = bench::remeasure_limits(best, [](std::string_view) {});
  EXPECT_EQ(again.one_gflops, 1e9);
  EXPECT_GT(again.all_gflops, 0);
  ASSERT_EQ(again.reading.size(), 2u);
  EXPECT_EQ(again.reading[0].one_gbs, 1e9);
  EXPECT_GT(again.reading[1].one_gbs, 0);
}

TEST(MachineLimits, BetweenSizesLieBetweenTheirRates) {
  const MachineLimits limits{.reading = {{1e6, 100, 200}, {1e8, 20, 30}, {1e9, 10, 11}}};
  EXPECT_EQ(limits.reading_gbs(1e5, 1), 100);
  EXPECT_NEAR(limits.reading_gbs(1e8, 1), 20, 1e-9);
  EXPECT_EQ(limits.reading_gbs(1e10, 2), 11);
  EXPECT_EQ(limits.memory_gbs(1), 10);
  double last = limits.reading_gbs(1e6, 2);
  for (double bytes = 1.3e6; bytes < 1e9; bytes *= 1.3) {
    const double rate = limits.reading_gbs(bytes, 2);
    EXPECT_LE(rate, last * (1 + 1e-12)) << bytes;
    last = rate;
  }
}

TEST(MachineLimits, ThatWereNotMeasuredAreNotNumbers) {
  EXPECT_TRUE(std::isnan(MachineLimits{}.memory_gbs(1)));
  EXPECT_TRUE(std::isnan(MachineLimits{}.reading_gbs(1e6, 1)));
}

TEST(LimitKernels, ReadEveryNumberOnceWithEachInstructionSet) {
  alignas(64) double values[256];
  for (int i = 0; i < 256; ++i) values[i] = i;
  for (const InstructionSet set : kSets) {
    if (set > best_instruction_set()) continue;
    EXPECT_EQ(bench::read_all(values, 256, set), 255 * 256 / 2) << static_cast<int>(set);
  }
}

TEST(LimitKernels, DoTheMultiplyAddsTheyCount) {
  for (const InstructionSet set : kSets) {
    if (set > best_instruction_set()) continue;
    double few = 0, many = 0;
    const double operations = bench::multiply_add(1, set, few);
    EXPECT_GT(operations, 0);
    EXPECT_EQ(bench::multiply_add(50, set, many), 50 * operations);
    EXPECT_NE(few, many) << static_cast<int>(set);
    EXPECT_TRUE(std::isfinite(many));
  }
}

}  // namespace
}  // namespace geotherm::test
