// SPDX-License-Identifier: MIT
// Curves of mesh edges as sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Error of the discretisation in edges, where neither the curve's ends nor the border are near,
// and anywhere.
constexpr double kBesideTheCurve = 1;
constexpr double kOnCurvesEverywhere = 2.5;
constexpr Index kN = 40;

HeatOptions in_mode(const std::string& backend, HeatMode mode) {
  HeatOptions options;
  options.backend = backend;
  options.heat = mode;
  return options;
}

/// A straight curve along the middle row, a quarter of the width from each border.
SourceSet middle_curve() {
  SourceSet set;
  for (Index i = kN / 4; i < 3 * kN / 4; ++i) {
    set.edges.push_back({grid_vertex(kN, i, kN / 2), grid_vertex(kN, i + 1, kN / 2)});
  }
  return set;
}
double to_middle_curve(const Vec3& p) {
  return (p - Vec3(std::clamp(p.x(), 0.25, 0.75), 0.5, 0)).norm();
}

using CurveCase = std::tuple<std::string, HeatMode>;

class CurveSources : public testing::TestWithParam<CurveCase> {
 protected:
  Draft draft = plane_grid(kN, kN, 1, 1);
  HeatMethod method =
      method_of(finish(draft), in_mode(std::get<0>(GetParam()), std::get<1>(GetParam())));
};

TEST_P(CurveSources, GiveTheDistanceToTheSegment) {
  const auto d = solve(method, middle_curve()).distances;
  for (std::size_t v = 0; v < d.size(); ++v) {
    const Vec3& p = draft.positions[v];
    const bool beside = p.x() > 0.3 && p.x() < 0.7 && std::abs(p.y() - 0.5) < 0.3;
    EXPECT_NEAR(d[v], to_middle_curve(p), (beside ? kBesideTheCurve : kOnCurvesEverywhere) / kN)
        << "at " << p.transpose();
  }
}

TEST_P(CurveSources, AreZeroOnTheCurve) {
  const SourceSet curve = middle_curve();
  const auto d = solve(method, curve).distances;
  for (const auto& [a, b] : curve.edges) {
    EXPECT_EQ(d[a], 0);
    EXPECT_EQ(d[b], 0);
  }
}

TEST_P(CurveSources, DoNotDependOnDirectionOrOrder) {
  SourceSet turned = middle_curve();
  std::ranges::reverse(turned.edges);
  for (auto& [a, b] : turned.edges) std::swap(a, b);
  EXPECT_EQ(solve(method, turned).distances, solve(method, middle_curve()).distances);
}

std::string curve_case_name(const testing::TestParamInfo<CurveCase>& each) {
  const char* const modes[] = {"unit", "diffuse", "hold"};
  return test_name(std::get<0>(each.param)) + "_" +
         modes[static_cast<int>(std::get<1>(each.param))];
}
INSTANTIATE_TEST_SUITE_P(Backends, CurveSources,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::Values(HeatMode::kUnit, HeatMode::kDiffuse,
                                                          HeatMode::kHold)),
                         curve_case_name);

TEST(CurveSource, IsBetterThanItsVerticesAlone) {
  // The rows beside the curve stand half a long edge aside: their nearest point is no vertex.
  constexpr Index kColumns = 12, kRows = 60;
  Draft draft = plane_grid(kColumns, kRows, 1, 1);
  for (Index j = 1; j <= kRows; j += 2) {
    for (Index i = 1; i < kColumns; ++i) {
      draft.positions[grid_vertex(kColumns, i, j)].x() += 0.5 / kColumns;
    }
  }
  const HeatMethod method = method_of(finish(draft));
  SourceSet curve;
  std::vector<Index> vertices = {grid_vertex(kColumns, 0, kRows / 2)};
  for (Index i = 0; i < kColumns; ++i) {
    vertices.push_back(grid_vertex(kColumns, i + 1, kRows / 2));
    curve.edges.push_back({vertices[i], vertices[i + 1]});
  }
  const auto error = [&](const SourceSet& set) {
    const auto d = solve(method, set).distances;
    double sum = 0;
    for (std::size_t v = 0; v < d.size(); ++v) {
      sum += std::abs(d[v] - std::abs(draft.positions[v].y() - 0.5));
    }
    return sum;
  };
  EXPECT_LT(error(curve), error(SourceSet::of_vertices(vertices)));
}

TEST(CurveSource, AlongEdgesThatWereFlippedAwayKeepsItsEnds) {
  Draft draft = plane_grid(20, 20, 1, 1);
  for (Vec3& p : draft.positions) p.x() += 2 * p.y();
  const HeatMethod method = method_of(finish(draft));
  ASSERT_GT(method.flips(), 0);
  SourceSet curve;  // the long diagonal of each cell on the way up
  for (Index i = 5; i < 15; ++i) {
    curve.edges.push_back({grid_vertex(20, i, i), grid_vertex(20, i + 1, i + 1)});
  }
  const auto d = solve(method, curve).distances;
  for (const auto& [a, b] : curve.edges) {
    EXPECT_EQ(d[a], 0);
    EXPECT_EQ(d[b], 0);
  }
  const Vec3 a = draft.positions[curve.edges.front()[0]];
  const Vec3 b = draft.positions[curve.edges.back()[1]];
  const double edge = (b - a).norm() / 10;
  for (std::size_t v = 0; v < d.size(); ++v) {
    const Vec3& p = draft.positions[v];
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    EXPECT_NEAR(d[v], (p - a - t * (b - a)).norm(), edge) << "vertex " << v;
  }
}

TEST(CurveSource, BetweenVerticesThatShareNoEdgeIsAnError) {
  SourceSet curve;
  curve.edges = {{0, 99}};
  const auto result = method_of(finish(plane_grid(20, 20, 1, 1))).solve(curve);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(result.error()).find("99"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
