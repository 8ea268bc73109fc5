// SPDX-License-Identifier: MIT
// Times so large that the heat is almost uniform: a worse distance, but no other one.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <tuple>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// How much worse than the method as published the default may be, in mean or largest error.
constexpr double kWorse = 1.1;

// The bound is a share of the largest distance: more than this in the mean is no longer that
// distance.
constexpr double kExtreme = 0.15;

struct ErrorsOfTime {
  double mean, largest;
};

class LargeTimes : public testing::TestWithParam<std::tuple<int, double>> {
 protected:
  Draft draft = sphere(5);
  std::vector<Index> sources =
      std::get<0>(GetParam()) == 1 ? std::vector<Index>{7} : std::vector<Index>{7, 400, 1500, 9300};

  /// Against the exact distances on the sphere, which chords undercut by less than a per mille.
  ErrorsOfTime errors(Variant variant) const {
    HeatOptions options;
    options.time_step.factor = std::get<1>(GetParam());
    options.variant = variant;
    const auto d = solve(finish(draft), sources, options).distances;
    ErrorsOfTime out{0, 0};
    for (std::size_t v = 0; v < d.size(); ++v) {
      double exact = kUnreached;
      for (const Index s : sources) {
        const Vec3& p = draft.positions[s];
        const Vec3& q = draft.positions[v];
        exact = std::min(exact, std::atan2(p.cross(q).norm(), p.dot(q)));
      }
      const double error = std::abs(d[v] - exact);
      out.mean += error / static_cast<double>(d.size());
      out.largest = std::max(out.largest, error);
    }
    return out;
  }
};

TEST_P(LargeTimes, AreNoWorseThanAsPublished) {
  const ErrorsOfTime corrected = errors(Variant::kCorrected);
  const ErrorsOfTime classic = errors(Variant::kClassic);
  EXPECT_LE(corrected.mean, kWorse * classic.mean);
  EXPECT_LE(corrected.largest, kWorse * classic.largest);
}

INSTANTIATE_TEST_SUITE_P(Sphere, LargeTimes,
                         testing::Combine(testing::Values(1, 4),
                                          testing::Values(1000.0, 10000.0, 1e6)),
                         [](const auto& each) {
                           return std::to_string(std::get<0>(each.param)) + "_sources_m_" +
                                  std::to_string(static_cast<int>(std::get<1>(each.param)));
                         });

// What t spoils is refused or said, never handed out in silence.
class ExtremeTimes : public testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(ExtremeTimes, GiveADistanceOrAWarningOrAnErrorWithTheCure) {
  const auto [backend, factor] = GetParam();
  const std::string hint = factor > 1 ? "smaller time-factor" : "larger time-factor";
  const Draft draft = sphere(3);
  HeatOptions options = with_backend(backend);
  options.time_step.factor = factor;
  const auto expect_hint = [&hint](const Error& error) {
    EXPECT_TRUE(error.code == ErrorCode::kNumericalFailure ||
                error.code == ErrorCode::kBudgetEnded);
    EXPECT_NE(sentence(error).find(hint), std::string::npos) << sentence(error);
  };
  const auto method = HeatMethod::build(finish(draft), options);
  if (!method) return expect_hint(method.error());
  const auto result = method->solve(SourceSet::of_vertices({7}));
  if (!result) return expect_hint(result.error());
  if (!result->warnings.empty()) return;
  double mean = 0;
  for (std::size_t v = 0; v < draft.positions.size(); ++v) {
    const Vec3& p = draft.positions[7];
    const Vec3& q = draft.positions[v];
    mean += std::abs(result->distances[v] - std::atan2(p.cross(q).norm(), p.dot(q)));
  }
  EXPECT_LE(mean / static_cast<double>(draft.positions.size()), kExtreme * std::numbers::pi);
}

INSTANTIATE_TEST_SUITE_P(Backends, ExtremeTimes,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::Values(1e-300, 1e-100, 1e-30, 1e-12, 1e-6, 1e6,
                                                          1e10, 1e12, 1e14, 1e16, 1e18, 1e20, 1e24,
                                                          1e100, 1e300)),
                         [](const auto& each) {
                           const double power = std::log10(std::get<1>(each.param));
                           return test_name(std::get<0>(each.param)) +
                                  (power < 0 ? "_minus_" : "_plus_") +
                                  std::to_string(std::lround(std::abs(power)));
                         });

TEST(AbsoluteTimes, ThatVanishBesideAnEdgeAreRefusedWithBothNumbers) {
  HeatOptions options;
  options.time_step = {TimeRule::kAbsolute, 1, 0.01};
  const auto method =
      HeatMethod::build(finish(transformed(sphere(2), 1e200, Vec3::Zero(), false)), options);
  ASSERT_FALSE(method);
  EXPECT_EQ(method.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(method.error()).find("e+199"), std::string::npos) << method.error().message;
}

}  // namespace
}  // namespace geotherm::test
