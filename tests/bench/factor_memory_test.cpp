// SPDX-License-Identifier: MIT
// What the analysis says of the memory that both factors take, and making them, against what the
// benchmark measures.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>

#include "bench/measure.h"
#include "solver/core/parallel.h"
#include "tests/linear/backend_fixture.h"

namespace geotherm::test {
namespace {

// Within a tenth where the threads run undisturbed; beside other programs their peaks do not meet.
constexpr double kResident = 0.2;

using Large = std::tuple<const char*, Draft (*)()>;

class FactorForecastSlow : public testing::TestWithParam<Large> {};

TEST_P(FactorForecastSlow, WithTheWorkIsNearWhatResidentMemoryGrowsBy) {
  const Analysed surface = analysed(*finish(std::get<1>(GetParam())()), backend_named("native"));
  const bench::PeakMemory peak;
  // As a set-up does it: both matrices at once.
  std::unique_ptr<Factorization> heat, poisson;
  const auto factor = [&](double mass, FactorStorage storage) {
    auto made =
        surface.analysis->factorize(std::make_shared<FemOperator>(surface.operators, mass, 1),
                                    {.threads = 1, .storage = storage});
    return made ? *std::move(made) : nullptr;
  };
  run_both(
      2, [&] { heat = factor(1, FactorStorage::kWideExponent); },
      [&] { poisson = factor(1e-6, FactorStorage::kSingle); });
  const double grown = peak.megabytes();
  ASSERT_TRUE(heat && poisson);
  if (grown == 0) GTEST_SKIP() << "the system does not say how much was resident at most";
  constexpr double kMegabyte = 1024.0 * 1024.0;
  const auto forecast =
      static_cast<double>(surface.analysis->factor_bytes(FactorStorage::kWideExponent) +
                          surface.analysis->factor_bytes(FactorStorage::kSingle) +
                          2 * surface.analysis->work_bytes()) /
      kMegabyte;
  EXPECT_NEAR(forecast, grown, kResident * grown);
}

// Large enough for what a heap keeps aside not to count.
INSTANTIATE_TEST_SUITE_P(Meshes, FactorForecastSlow,
                         testing::Values(Large{"torus", [] { return torus(600, 350, 0.4); }},
                                         Large{"jittered_plane",
                                               [] { return jittered_plane(450, 0.35, 3); }}),
                         [](const auto& each) { return std::string(std::get<0>(each.param)); });

}  // namespace
}  // namespace geotherm::test
