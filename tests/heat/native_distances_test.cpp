// SPDX-License-Identifier: MIT
// Distances by the native backend on meshes large enough for narrow factors, against those of a
// backend that keeps doubles.
#include <gtest/gtest.h>

#include "geotherm/heat_method.h"
#include "tests/support/compare.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// What is promised of the largest distance.
constexpr double kCompact = 1e-7;
constexpr double kFull = 1e-10;

/// 24,000 vertices, above the size from which factors are narrow.
MeshPtr large_mesh() {
  static const MeshPtr kMesh = finish(torus(200, 120, 0.4));
  return kMesh;
}

HeatOptions options(const std::string& backend, Precision precision = Precision::kCompact) {
  HeatOptions out;
  out.backend = backend;
  out.precision = precision;
  out.strict = true;
  return out;
}

struct Setting {
  const char* name;
  void (*set)(HeatOptions&);
};
const Setting kSettings[] = {
    {"default", [](HeatOptions&) {}},
    {"hold", [](HeatOptions& o) { o.heat = HeatMode::kHold; }},
};
const Setting kMoreSettings[] = {
    {"classic", [](HeatOptions& o) { o.variant = Variant::kClassic; }},
    {"diffuse", [](HeatOptions& o) { o.heat = HeatMode::kDiffuse; }},
    {"pin_vertex", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPinVertex; }},
    {"penalty", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPenalty; }},
    {"conserve_energy",
     [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kConserveEnergy; }},
    {"pseudo_inverse", [](HeatOptions& o) { o.constraint.mode = ConstraintMode::kPseudoInverse; }},
    {"long_time", [](HeatOptions& o) { o.time_step.factor = 100; }},
};

void PrintTo(const Setting& setting, std::ostream* out) { *out << setting.name; }

class NativeDistances : public testing::TestWithParam<Setting> {
 protected:
  std::vector<double> distances(HeatOptions options) const {
    GetParam().set(options);
    return solve(large_mesh(), {0, 12'345}, options).distances;
  }
};

TEST_P(NativeDistances, AreThoseOfDoublesAsFarAsPromised) {
  const std::vector<double> doubles = distances(options("eigen-ldlt"));
  const std::vector<double> compact = distances(options("native"));
  EXPECT_LE(relative_difference(compact, doubles), kCompact);
  EXPECT_NE(compact, distances(options("native", Precision::kFull)));  // it is compact
  EXPECT_LE(relative_difference(distances(options("native", Precision::kRefined)), doubles), kFull);
  EXPECT_LE(relative_difference(distances(options("native", Precision::kFull)), doubles), kFull);
}

TEST_P(NativeDistances, HaveTheSameBitsForAnyNumberOfThreads) {
  HeatOptions one = options("native");
  one.threads = 1;
  const std::vector<double> alone = distances(one);
  for (const int threads : kSanitized ? std::vector{5} : std::vector{2, 5}) {
    HeatOptions more = one;
    more.threads = threads;
    EXPECT_EQ(distances(more), alone);
  }
}

std::string setting_name(const testing::TestParamInfo<Setting>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Settings, NativeDistances, testing::ValuesIn(kSettings), setting_name);
INSTANTIATE_TEST_SUITE_P(SettingsSlow, NativeDistances, testing::ValuesIn(kMoreSettings),
                         setting_name);

TEST(NativeBackend, IsTheDefault) {
  const auto method = HeatMethod::build(finish(sphere(2)));
  ASSERT_TRUE(method);
  EXPECT_EQ(method->options().backend, "native");
}

TEST(NativeBackend, HalvesWhatDoublesTake) {
  const auto compact = HeatMethod::build(large_mesh(), options("native"));
  const auto full = HeatMethod::build(large_mesh(), options("native", Precision::kFull));
  ASSERT_TRUE(compact && full);
  EXPECT_DOUBLE_EQ(compact->memory_mb() * 2, full->memory_mb());
  EXPECT_DOUBLE_EQ(compact->memory_mb(), compact->forecast_mb());
  EXPECT_DOUBLE_EQ(full->memory_mb(), full->forecast_mb());
}

TEST(NativeBackend, IsAsRightWithManySourcesAsWithOneSlow) {
  // The more sources, the smaller a part of phi's range distances are, and the more of them is what
  // rounds phi. Fifty are not refined, 700 are.
  for (const ConstraintMode mode : {ConstraintMode::kPinSources, ConstraintMode::kPinVertex}) {
    HeatOptions narrow = options("native"), wide = options("eigen-ldlt");
    narrow.constraint.mode = wide.constraint.mode = mode;
    const auto native = HeatMethod::build(large_mesh(), narrow);
    const auto doubles = HeatMethod::build(large_mesh(), wide);
    ASSERT_TRUE(native && doubles);
    for (const Index count : {50, 700}) {
      std::vector<Index> sources;
      for (Index k = 0; k < count; ++k) sources.push_back(k * 7919 % large_mesh()->vertex_count());
      const auto answer = native->solve(SourceSet::of_vertices(sources));
      const auto expected = doubles->solve(SourceSet::of_vertices(sources));
      ASSERT_TRUE(answer && expected);
      const double error = relative_difference(answer->distances, expected->distances);
      EXPECT_LE(error, kCompact);
      EXPECT_EQ(error > kFull, count == 50);
    }
  }
}

TEST(NativeBackend, RoundsWithoutAlarm) {
  const auto method = HeatMethod::build(large_mesh(), options("native"));
  ASSERT_TRUE(method);
  const auto answer = method->solve(SourceSet::of_vertices({5}));
  ASSERT_TRUE(answer);
  EXPECT_GT(answer->quality.poisson_residual, 1e-10);  // it did round
  EXPECT_EQ(method->warnings(), std::vector<Warning>());
  EXPECT_EQ(answer->warnings, std::vector<Warning>());
}

TEST(NativeBackend, KeepsDoublesWhereWeightsDifferByManyOrdersSlow) {
  // Two tori that a thread of needles joins: what passes through it is next to nothing beside what
  // passes within them, and would drown in the rounding of narrow numbers.
  Draft draft = torus(200, 120, 0.4);
  for (Vec3& p : draft.positions) {
    if (p.x() > 0) p.y() *= 1e-5;
  }
  const MeshPtr mesh = finish(std::move(draft));
  const auto native = solve(mesh, {0}, options("native")).distances;
  const auto doubles = solve(mesh, {0}, options("eigen-ldlt")).distances;
  EXPECT_LE(relative_difference(native, doubles), 1e-6);
}

}  // namespace
}  // namespace geotherm::test
