// SPDX-License-Identifier: MIT
// What queries report, refuse, and how they stop.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

/// Mean of | |grad d| - 1 | by area: d = d_0 + g . (p - p_0) at all corners, g in the face's plane.
double mean_slope_error(const Draft& draft, std::span<const double> d) {
  double sum = 0, area = 0;
  for (const auto& [a, b, c] : draft.faces) {
    const Vec3 u = draft.positions[b] - draft.positions[a];
    const Vec3 v = draft.positions[c] - draft.positions[a];
    Eigen::Matrix2d products;
    products << u.dot(u), u.dot(v), u.dot(v), v.dot(v);
    const Eigen::Vector2d falls(d[b] - d[a], d[c] - d[a]);
    const double slope = std::sqrt(falls.dot(products.inverse() * falls));
    const double twice = std::sqrt(products.determinant());
    sum += twice * std::abs(slope - 1);
    area += twice;
  }
  return sum / area;
}

class WaveQueries : public testing::TestWithParam<MethodKind> {
 protected:
  MeshPtr mesh = finish(sphere(4));
  std::shared_ptr<const DistanceMethod> method = method_of(mesh, GetParam());
};

TEST_P(WaveQueries, KnowTheirKindAndWhatTheyCost) {
  EXPECT_EQ(method->kind(), GetParam());
  EXPECT_EQ(method->heat(), nullptr);
  EXPECT_GT(method->memory_mb(), 0);
  EXPECT_GT(method->timing().setup, 0);
  const auto result = solve(*method, SourceSet::of_vertices({3}));
  EXPECT_GT(result.timing.query, 0);
  EXPECT_EQ(result.timing.diffuse, 0);
  EXPECT_EQ(result.timing.poisson, 0);
  EXPECT_TRUE(result.warnings.empty());
}

TEST_P(WaveQueries, JudgeTheirAnswers) {
  constexpr double kRoundOff = 1e-12;
  Draft plane = plane_grid(20, 15, 20, 15);
  // Equilateral, so that no edge is flipped; of two sizes, so that areas count.
  for (Vec3& p : plane.positions) p = Vec3(p.x() - p.y() / 2, p.y() * std::sqrt(0.75), 0);
  append(plane, transformed(plane, 3, Vec3(100, 0, 0), true));
  const auto on_plane = method_of(finish(plane), GetParam());
  const SourceSet sources = SourceSet::of_vertices({3, 500});
  const auto result = solve(*on_plane, sources);
  const double expected = mean_slope_error(plane, result.distances);
  EXPECT_GT(expected, 1e3 * kRoundOff);
  EXPECT_NEAR(result.quality.eikonal_error_mean, expected, kRoundOff);
  // A source's value is a minimum that starts at its offset.
  EXPECT_EQ(result.quality.max_source_distance, 0);
  EXPECT_EQ(solve(*on_plane, sources, {.quality = false}).quality.eikonal_error_mean, 0);
}

TEST_P(WaveQueries, LeaveNothingBehind) {
  const SourceSet first = SourceSet::of_vertices({3}), second = SourceSet::of_vertices({900, 17});
  const auto before = solve(*method, first).distances;
  solve(*method, second, {true, false, true});
  EXPECT_EQ(solve(*method, first).distances, before);
}

TEST_P(WaveQueries, StopWhenTheyAreToldTo) {
  const auto large = method_of(finish(torus(300, 100, 0.4)), GetParam());
  const SourceSet set = SourceSet::of_vertices({0});
  const auto before = solve(*large, set).distances;
  int calls = 0;
  double share = 0;
  ASSERT_TRUE(large->solve(set, {}, [&](std::string_view, double now) {
    EXPECT_GE(now, share);
    EXPECT_LE(now, 1);
    share = now;
    ++calls;
    return true;
  }));
  EXPECT_GE(calls, 3);
  for (int most : {0, 1, calls - 1}) {
    const auto stopped =
        large->solve(set, {}, [&most](std::string_view, double) { return most-- > 0; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
  }
  EXPECT_EQ(solve(*large, set).distances, before);
}

struct BadSource {
  const char* name;
  SourceSet sources;
  const char* says;  ///< part of the message
};

SourceSet at(const SurfacePoint& point) { return {{SurfacePoint::at_vertex(0), point}, {}}; }

SourceSet with_offsets(std::vector<double> offsets) {
  SourceSet set = SourceSet::of_vertices({1, 2});
  set.offsets = std::move(offsets);
  return set;
}

// The mesh: 162 vertices of a sphere, vertex 162 in no face, face 320 with a repeated corner.
const BadSource kBadSources[] = {
    {"none", {}, "no source"},
    {"vertex_beyond_the_last", SourceSet::of_vertices({0, 163}), "163"},
    {"negative_vertex", SourceSet::of_vertices({-5}), "-5"},
    {"vertex_in_no_face", SourceSet::of_vertices({162}), "162"},
    {"face_beyond_the_last", at(SurfacePoint::in_face(321, {0.2, 0.3, 0.5})), "321"},
    {"negative_face", at(SurfacePoint::in_face(-3, {0.2, 0.3, 0.5})), "-3"},
    {"weights_that_sum_to_two", at(SurfacePoint::in_face(7, {1, 0.5, 0.5})), "2"},
    {"weight_that_is_no_number", at(SurfacePoint::in_face(7, {kNan, 0.5, 0.5})), "7"},
    {"face_without_an_inside", at(SurfacePoint::in_face(320, {0.2, 0.3, 0.5})), "320"},
    {"edge_with_a_vertex_beyond_the_last", {{}, {{0, 500}}}, "500"},
    {"vertices_without_an_edge", {{}, {{0, 150}}}, "150"},
    {"offset_below_zero", with_offsets({0, -0.5}), "-0.5"},
    {"offset_that_is_no_number", with_offsets({kNan, 0}), "nan"},
    {"endless_offset", with_offsets({0, kUnreached}), "inf"},
    {"too_few_offsets", with_offsets({1}), "1 offset"},
};
void PrintTo(const BadSource& bad, std::ostream* out) { *out << bad.name; }

class BadWaveSources : public testing::TestWithParam<BadSource> {};

TEST_P(BadWaveSources, AreRefusedByTheirNumber) {
  Draft draft = sphere(2);
  draft.add({4, 4, 4});
  draft.faces.push_back({1, 2, 1});
  const MeshPtr mesh = finish(draft);
  for (const MethodKind kind : kWaveKinds) {
    const auto result = method_of(mesh, kind)->solve(GetParam().sources);
    ASSERT_FALSE(result) << kind_name(kind);
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
    EXPECT_NE(sentence(result.error()).find(GetParam().says), std::string::npos)
        << result.error().message;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, WaveQueries, testing::ValuesIn(kWaveKinds),
                         [](const auto& each) { return kind_name(each.param); });
INSTANTIATE_TEST_SUITE_P(Sources, BadWaveSources, testing::ValuesIn(kBadSources),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace geotherm::test
