// SPDX-License-Identifier: MIT
// Components share a file and nothing else: not the time, not what is wrong with another one.
#include "solver/heat/heat_step.h"

#include <gtest/gtest.h>

#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// What the digits of another unit of length and another order of elimination leave.
constexpr double kTimesRoundOff = 1e-8;
constexpr double kIterativeTimes = 1e-6;

struct Neighbour {
  const char* name;
  Draft (*draft)();
};

Draft degenerate() {
  return {{{9, 0, 0}, {10, 0, 0}, {9.5, 0, 0}, {9.5, 1, 0}, {9, 9, 9}},
          {{0, 1, 2}, {1, 0, 3}, {4, 4, 1}}};
}

const Neighbour kNeighbours[] = {
    {"Huge", [] { return transformed(plane_grid(4, 4, 1, 1), 1e6, Vec3(5, 0, 0), true); }},
    {"Tiny", [] { return transformed(sphere(3), 1e-9, Vec3(5, 0, 0), true); }},
    {"Degenerate", degenerate},
    {"OnePoint",
     [] {
       return Draft{{{9, 0, 0}, {9, 0, 0}, {9, 0, 0}}, {{0, 1, 2}}};
     }},
    {"OneSided", [] { return transformed(moebius(20, 3), 1, Vec3(9, 0, 0), false); }},
};

void PrintTo(const Neighbour& each, std::ostream* out) { *out << each.name; }

class ComponentBeside : public testing::TestWithParam<Neighbour> {
 protected:
  /// Distances on the first component alone, and beside the neighbour, which has a source too.
  void expect_same(const HeatOptions& options, double tolerance) const {
    Draft draft = transformed(sphere(2), 0.01, Vec3(0, 0, 1), false);
    for (Vec3& p : draft.positions) p.x() *= 0.3;
    const auto alone = solve(finish(draft), {3}, options).distances;
    const Index first = draft.vertex_count();
    append(draft, GetParam().draft());
    const auto both = solve(finish(draft), {3, first}, options).distances;
    const double most = largest(alone);
    for (std::size_t v = 0; v < alone.size(); ++v) {
      EXPECT_NEAR(both[v], alone[v], tolerance * most) << v;
    }
    EXPECT_EQ(both[static_cast<std::size_t>(first)], 0);
  }
};

TEST_P(ComponentBeside, ChangesNoDistance) {
  for (const TimeRule rule : {TimeRule::kMeanEdge, TimeRule::kMeanFaceArea}) {
    HeatOptions options;
    options.time_step.rule = rule;
    expect_same(options, kTimesRoundOff);
  }
}

TEST_P(ComponentBeside, ChangesNoDistanceOfAnIterativeBackend) {
  for (const std::string& name : iterative_backends()) {
    expect_same(with_backend(name), kIterativeTimes);
  }
}

TEST_P(ComponentBeside, ChangesNoDistanceWithHeldHeatAndHeldBorders) {
  HeatOptions options;
  options.boundary = BoundaryRule::kAverage;
  options.heat = HeatMode::kHold;
  expect_same(options, kTimesRoundOff);
}

INSTANTIATE_TEST_SUITE_P(Neighbours, ComponentBeside, testing::ValuesIn(kNeighbours),
                         [](const auto& each) { return each.param.name; });

TEST(TimeOfSeveralComponents, IsThatOfTheOneWithMostFaces) {
  constexpr double kScale = 1e-3;
  Draft draft = sphere(1);
  append(draft, transformed(sphere(2), kScale, Vec3(5, 0, 0), false));
  const double alone = method_of(finish(sphere(2))).t() * kScale * kScale;
  const HeatMethod method = method_of(finish(draft));
  EXPECT_NEAR(method.t(), alone, 1e-9 * alone);
  EXPECT_NEAR(method.relative_t(), 1, 1e-12);
  const auto [least, most] = method.t_range();
  EXPECT_NEAR(least, alone, 1e-9 * alone);
  const double large = method_of(finish(sphere(1))).t();
  EXPECT_NEAR(most, large, 1e-9 * large);
  EXPECT_TRUE(method.warnings().empty());
}

TEST(TimeOfOneComponent, IsOneNumber) {
  const HeatMethod method = method_of(finish(sphere(2)));
  EXPECT_EQ(method.t_range()[0], method.t());
  EXPECT_EQ(method.t_range()[1], method.t());
  EXPECT_EQ(method.relative_t(), 1);
}

}  // namespace
}  // namespace geotherm::test
