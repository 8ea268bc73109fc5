// SPDX-License-Identifier: MIT
#include "geotherm/accuracy.h"

#include <gtest/gtest.h>

namespace geotherm {
namespace {

TEST(DistanceErrorTest, IsRelativeToTheBetterDistanceAndToTheRange) {
  const std::vector<double> e = {0, 1, 2, 4};
  const std::vector<double> d = {0, 1.1, 1.8, 4};
  const DistanceError error = distance_error(d, e);
  EXPECT_DOUBLE_EQ(error.mean_relative, (0.1 + 0.1 + 0) / 3);
  EXPECT_DOUBLE_EQ(error.max, 0.2);
  EXPECT_DOUBLE_EQ(error.max_of_range, 0.05);
  EXPECT_EQ(error.worst, 2);
  EXPECT_NEAR(error.mean_signed, (0.1 - 0.2) / 4, 1e-15);  // differences of decimals
}

TEST(DistanceErrorTest, LeavesOutWhatIsNotReachedAndCountsDisagreement) {
  const std::vector<double> e = {0, 1, kUnreached, kUnreached};
  const std::vector<double> d = {0, 1, kUnreached, 3};
  const DistanceError error = distance_error(d, e);
  EXPECT_EQ(error.mean_relative, 0);
  EXPECT_EQ(error.max, 0);
  EXPECT_EQ(error.differently_reached, 1);
}

TEST(DistanceErrorTest, HasNoWorstVertexWhereNothingIsReached) {
  const std::vector<double> nothing = {kUnreached, kUnreached};
  const DistanceError error = distance_error(nothing, nothing);
  EXPECT_EQ(error.worst, kNoIndex);
  EXPECT_EQ(error.max_of_range, 0);
}

TEST(DistanceErrorTest, SignedErrorIsInfiniteWhereEitherIs) {
  const std::vector<double> d = {1, kUnreached, 3}, e = {2, 1, kUnreached};
  EXPECT_EQ(signed_error(d, e), (std::vector<double>{-1, kUnreached, kUnreached}));
}

TEST(ErrorHistogramTest, CountsEveryFiniteValueOnce) {
  const std::vector<double> values = {-1, -0.5, 0, 0.99, 1, kUnreached};
  const ErrorHistogram histogram = error_histogram(values, 4);
  EXPECT_EQ(histogram.low, -1);
  EXPECT_EQ(histogram.high, 1);
  EXPECT_EQ(histogram.count, (std::vector<Index>{1, 1, 1, 2}));
}

TEST(ErrorHistogramTest, HoldsOneValueInOnePart) {
  const std::vector<double> same = {2, 2, 2};
  const ErrorHistogram histogram = error_histogram(same, 3);
  EXPECT_EQ(histogram.count, (std::vector<Index>{3, 0, 0}));
}

TEST(ReferenceForTest, IsMoreAccurateThanTheMethodOrIsIt) {
  constexpr Index kSmall = 1000, kLarge = 10'000'000;
  EXPECT_EQ(reference_for(MethodKind::kHeat, kSmall), MethodKind::kExact);
  EXPECT_EQ(reference_for(MethodKind::kHeat, kLarge), MethodKind::kWavefrontFine);
  EXPECT_EQ(reference_for(MethodKind::kWavefrontFine, kSmall), MethodKind::kExact);
  EXPECT_EQ(reference_for(MethodKind::kExact, kSmall), MethodKind::kExact);
  EXPECT_EQ(reference_for(MethodKind::kWavefrontFine, kLarge), MethodKind::kWavefrontFine)
      << "windows would take more than seconds";
  EXPECT_TRUE(is_better(MethodKind::kExact, MethodKind::kWavefrontFine));
  EXPECT_FALSE(is_better(MethodKind::kHeat, MethodKind::kFastMarching));
}

}  // namespace
}  // namespace geotherm
