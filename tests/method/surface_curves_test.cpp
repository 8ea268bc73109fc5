// SPDX-License-Identifier: MIT
// Curves across faces as sources: the distance to a straight line on a plane, in closed form.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geotherm/build_method.h"
#include "geotherm/mesh.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

constexpr Index kN = 24;
const Vec3 kFrom(0.23, 0.31, 0), kTo(0.79, 0.62, 0);

/// Weights in a face of the plane.
std::array<double, 3> weights_in(const TriangleMesh& mesh, Index f, const Vec3& p) {
  const Face& face = mesh.faces()[f];
  const auto corner = [&](int k) -> const Vec3& { return mesh.positions()[face[k]]; };
  const auto area = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a).z();
  };
  const double whole = area(corner(0), corner(1), corner(2));
  std::array<double, 3> out = {area(p, corner(1), corner(2)) / whole,
                               area(corner(0), p, corner(2)) / whole, 0};
  for (double& w : out) w = std::clamp(w, 0.0, 1.0);
  out[2] = std::max(0.0, 1 - out[0] - out[1]);
  return out;
}

/// The line from kFrom to kTo, cut where it crosses edges of the grid.
SourceSet slanted_line(const TriangleMesh& mesh) {
  std::vector<double> cuts = {0, 1};
  for (const Vec3& across : {Vec3(kN, 0, 0), Vec3(0, kN, 0), Vec3(kN, -kN, 0), Vec3(kN, kN, 0)}) {
    const double from = across.dot(kFrom), to = across.dot(kTo);
    for (double level = std::ceil(std::min(from, to)); level < std::max(from, to); ++level) {
      cuts.push_back((level - from) / (to - from));
    }
  }
  std::ranges::sort(cuts);
  SourceSet set;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const auto at = [](double share) { return Vec3((1 - share) * kFrom + share * kTo); };
    if (cuts[i] - cuts[i - 1] < 1e-9) continue;
    const Index f = closest_point(mesh, at((cuts[i - 1] + cuts[i]) / 2))->point.face;
    set.segments.push_back(
        {f, weights_in(mesh, f, at(cuts[i - 1])), weights_in(mesh, f, at(cuts[i])), 0});
  }
  return set;
}

double to_line(const Vec3& p) {
  const Vec3 along = kTo - kFrom;
  const double share = std::clamp((p - kFrom).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - kFrom - share * along).norm();
}

using CurveCase = std::tuple<MethodKind, int>;  // refine

class SurfaceCurves : public testing::TestWithParam<CurveCase> {};

TEST_P(SurfaceCurves, GiveTheDistanceToTheLine) {
  const auto [kind, refine] = GetParam();
  const MeshPtr mesh = finish(plane_grid(kN, kN, 1, 1));
  MethodOptions options;
  options.method = kind;
  options.refine = refine;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method) << method.error().message;
  const auto result = (*method)->solve(slanted_line(*mesh), {.nearest = kind != MethodKind::kHeat});
  ASSERT_TRUE(result) << result.error().message;
  // In edges; for heat that of curves of edges, about their ends.
  const double tolerance = kind == MethodKind::kHeat           ? 2.5
                           : kind == MethodKind::kFastMarching ? 1.3
                           : kind == MethodKind::kWavefront    ? 0.25
                                                               : 1e-9;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3& p = mesh->positions()[v];
    EXPECT_NEAR(result->distances[v], to_line(p), tolerance / kN) << "at " << p.transpose();
  }
  for (const Index group : result->nearest_source) ASSERT_EQ(group, 0) << "one curve is one group";
}

INSTANTIATE_TEST_SUITE_P(Methods, SurfaceCurves,
                         testing::Combine(testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                                          MethodKind::kFastMarching,
                                                          MethodKind::kExact),
                                          testing::Values(0, 1)),
                         [](const auto& each) {
                           return test_name(to_text(std::get<0>(each.param))) + "Refined" +
                                  std::to_string(std::get<1>(each.param));
                         });

TEST(SurfaceCurve, IsBetterThanTheVerticesNearIt) {
  const MeshPtr mesh = finish(plane_grid(kN, kN, 1, 1));
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  const SourceSet line = slanted_line(*mesh);
  std::vector<Index> near;
  for (const FaceSegment& segment : line.segments) {
    const auto most = std::ranges::max_element(segment.from) - segment.from.begin();
    near.push_back(mesh->faces()[segment.face][static_cast<std::size_t>(most)]);
  }
  const auto error = [&](const SourceSet& set) {
    const auto d = (*method)->solve(set, {})->distances;
    double sum = 0;
    for (std::size_t v = 0; v < d.size(); ++v)
      sum += std::abs(d[v] - to_line(mesh->positions()[v]));
    return sum / static_cast<double>(d.size());
  };
  EXPECT_LT(5 * error(line), error(SourceSet::of_vertices(near)));
}

TEST(SurfaceCurve, AlongAnEdgeOfTheRefinedMeshIsInOnePartAtATime) {
  const MeshPtr mesh = finish(plane_grid(kN, kN, 1, 1));
  SourceSet
      set;  // a weight of 3/8 is an edge of the parts of eighths, and rounding must not matter
  set.segments = {{0,
                   {0.375, 0.3763709621663579, 0.2486290378336421},
                   {0.375, 0.26747158331692444, 0.35752841668307556},
                   0}};
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  const auto coarse = (*build_method(mesh, options))->solve(set, {});
  options.refine = 3;
  const auto fine = (*build_method(mesh, options))->solve(set, {});
  ASSERT_TRUE(coarse);
  ASSERT_TRUE(fine) << fine.error().message;
  const double h = 1.0 / kN;
  for (std::size_t v = 0; v < fine->distances.size(); ++v) {
    EXPECT_NEAR(fine->distances[v], coarse->distances[v], h / 8) << v;
  }
}

TEST(SurfaceCurve, HasAGroupOfItsOwn) {
  SourceSet set = SourceSet::of_vertices({5});
  set.segments = {{0, {1, 0, 0}, {0, 1, 0}, 3}, {1, {1, 0, 0}, {0, 1, 0}, 1}, {2, {}, {}, 3}};
  const SourceGroups groups = source_groups(set);
  EXPECT_EQ(groups.of_segment, (std::vector<Index>{1, 2, 1}));
  EXPECT_EQ(groups.count, 3);
}

TEST(SurfaceCurve, InAFaceThatIsNotThereIsAnError) {
  SourceSet set;
  set.segments = {{kN * kN * 2, {1, 0, 0}, {0, 1, 0}, 0}};
  const auto result = method_of(finish(plane_grid(kN, kN, 1, 1))).solve(set);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(result.error()).find("1152"), std::string::npos) << sentence(result.error());
}

}  // namespace
}  // namespace geotherm::test
