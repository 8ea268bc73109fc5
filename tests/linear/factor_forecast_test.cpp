// SPDX-License-Identifier: MIT
// What the analysis says of the memory of a factor, against the factor.
#include <gtest/gtest.h>

#include <tuple>

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
const Shape kForecastShapes[] = {
    {"small_sphere", [] { return sphere(2); }},
    {"torus", [] { return torus(70, 40, 0.4); }},
    {"plane", [] { return jittered_plane(90, 0.35, 3); }},
    {"sphere", [] { return sphere(5); }},
    {"band", [] { return moebius(200, 9); }},
    {"large", [] { return torus(200, 110, 0.4); }},  // where narrow factors are narrow
};

using ForecastCase = std::tuple<std::string, Shape>;

class FactorForecast : public testing::TestWithParam<ForecastCase> {};

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
                                          testing::ValuesIn(kForecastShapes)),
                         [](const auto& each) {
                           return test_name(std::get<0>(each.param)) + "_" +
                                  std::get<1>(each.param).name;
                         });

}  // namespace
}  // namespace geotherm::test
