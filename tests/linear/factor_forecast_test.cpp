// SPDX-License-Identifier: MIT
// What the analysis says of the memory of a factor, against the factor.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <tuple>

#include "solver/core/keep_freed_memory.h"
#include "solver/core/parallel.h"
#include "tests/linear/backend_fixture.h"

namespace geotherm::test {
namespace {

// The forecast is the count itself for the backends there are; a library may store a little more.
constexpr double kForecast = 0.1;

struct Shape {
  const char* name;
  Draft (*draft)();
};

// From columns alone to large supernodes, with and without a border.
const Shape kShapes[] = {
    {"small_sphere", [] { return sphere(2); }},
    {"torus", [] { return torus(70, 40, 0.4); }},
    {"plane", [] { return jittered_plane(90, 0.35, 3); }},
    {"sphere", [] { return sphere(5); }},
    {"band", [] { return moebius(200, 9); }},
    {"large", [] { return torus(200, 110, 0.4); }},  // where narrow factors are narrow
};

using Case = std::tuple<std::string, Shape>;

class FactorForecast : public testing::TestWithParam<Case> {};

TEST_P(FactorForecast, IsWhatTheFactorTakes) {
  const Backend& backend = backend_named(std::get<0>(GetParam()));
  const Analysed surface = analysed(*finish(std::get<1>(GetParam()).draft()), backend);
  for (const FactorStorage storage :
       {FactorStorage::kFull, FactorStorage::kSingle, FactorStorage::kWideExponent}) {
    const auto factor = surface.analysis->factorize(
        std::make_shared<FemOperator>(surface.operators, 1, 1), {.threads = 1, .storage = storage});
    ASSERT_TRUE(factor);
    const auto bytes = static_cast<double>((*factor)->stats().bytes);
    EXPECT_NEAR(static_cast<double>(surface.analysis->factor_bytes(storage)), bytes,
                kForecast * bytes);
  }
  EXPECT_EQ(surface.analysis->work_bytes() > 0, !backend.iterative());
}

INSTANTIATE_TEST_SUITE_P(Backends, FactorForecast,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::ValuesIn(kShapes)),
                         [](const auto& each) {
                           return test_name(std::get<0>(each.param)) + "_" +
                                  std::get<1>(each.param).name;
                         });

/// A line of /proc/self/status, in bytes; 0 where the system has none.
double memory_status(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return std::stod(line.substr(key.size() + 1)) * 1024;
  }
  return 0;
}

/// Begins the highest resident memory anew.
bool forget_peak() {
  std::ofstream refs("/proc/self/clear_refs");
  return bool(refs << 5 << std::flush);
}

// Within a tenth where the threads run undisturbed; beside other programs their peaks do not meet.
constexpr double kResident = 0.2;

using Large = std::tuple<const char*, Draft (*)()>;

class FactorForecastSlow : public testing::TestWithParam<Large> {};

TEST_P(FactorForecastSlow, WithTheWorkIsNearWhatResidentMemoryGrowsBy) {
  const Analysed surface = analysed(*finish(std::get<1>(GetParam())()), backend_named("native"));
  release_freed_memory();
  const double before = memory_status("VmRSS");
  if (before == 0 || !forget_peak()) GTEST_SKIP() << "the system does not say what is resident";
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
  const double grown = memory_status("VmHWM") - before;
  ASSERT_TRUE(heat && poisson);
  if (grown <= 0) GTEST_SKIP() << "the system does not say how much was resident at most";
  const auto forecast = static_cast<double>(
      surface.analysis->factor_bytes(FactorStorage::kWideExponent) +
      surface.analysis->factor_bytes(FactorStorage::kSingle) + 2 * surface.analysis->work_bytes());
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
