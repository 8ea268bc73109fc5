// SPDX-License-Identifier: MIT
#include "app/picture/picture_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/picture/picture_scale.h"
#include "geotherm/accuracy.h"
#include "geotherm/heat_method.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

using app::kNoPictureValue;
using app::picture_of;
using app::picture_of_frame;
using app::picture_scale;
using app::PictureData;
using app::PictureScale;
using app::PictureSettings;

// Positions are floats of size 1; sums of three of them.
constexpr double kSceneRounding = 1e-6;

Vec3 wide(const PictureData::Vector& v) { return {v[0], v[1], v[2]}; }

/// Places in the scene are those of the mesh, moved and scaled as the data say.
void expect_same_shape(const PictureData& data, const TriangleMesh& mesh) {
  double radius = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 place = wide(data.positions[static_cast<std::size_t>(v)]);
    radius = std::max(radius, place.norm());
    const Vec3 expected = (mesh.positions()[v] - data.centre) / data.model_per_scene;
    EXPECT_LE((place - expected).norm(), kSceneRounding) << v;
  }
  EXPECT_NEAR(radius, 1, kSceneRounding);
}

class PictureScene : public testing::TestWithParam<double> {};

TEST_P(PictureScene, HoldsAModelOfAnySizeWithinRadiusOne) {
  const MeshPtr mesh = finish(transformed(torus(12, 8, 0.4), GetParam(), Vec3::Zero(), true));
  expect_same_shape(picture_of(*mesh), *mesh);
}

INSTANTIATE_TEST_SUITE_P(Of, PictureScene, testing::Values(1e-300, 1e-150, 1.0, 1e6, 1e150, 1e307),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

TEST(PictureSceneOf, AModelFarFromTheOriginKeepsItsShape) {
  const MeshPtr mesh = finish(transformed(torus(12, 8, 0.4), 1, Vec3(1e8, -2e8, 3e8), false));
  expect_same_shape(picture_of(*mesh), *mesh);
}

TEST(PictureSceneOf, CoordinatesAtBothEndsOfTheDoublesIsFinite) {
  constexpr double kMax = 1.7e308;
  const MeshPtr mesh = finish({{{-kMax, 0, 0}, {kMax, 0, 0}, {0, kMax, -kMax}}, {{0, 1, 2}}});
  const PictureData data = picture_of(*mesh);
  for (const PictureData::Vector& place : data.positions)
    EXPECT_LE(wide(place).norm(), 1 + kSceneRounding);
  EXPECT_TRUE(std::isfinite(data.model_per_scene));
}

TEST(PictureSceneOf, OnePointIsAtTheOrigin) {
  const Vec3 p(3, 4, 5);
  const PictureData data = picture_of(*finish({{p, p, p}, {{0, 1, 2}}}));
  for (const PictureData::Vector& place : data.positions) EXPECT_EQ(wide(place), Vec3::Zero());
  EXPECT_EQ(data.model_per_scene, 1);
}

TEST(PictureOfAFrame, LiesInTheSceneOfAllFramesWhichTheCameraFits) {
  const std::vector<Vec3> extent = {{0, 0, 0}, {10, 0, 0}, {0, 2, 0}};
  const MeshPtr first = finish({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const MeshPtr last = finish({{{9, 0, 0}, {10, 0, 0}, {9, 1, 0}}, {{0, 1, 2}}});
  const PictureData a = picture_of_frame(*first, extent), b = picture_of_frame(*last, extent);
  EXPECT_EQ(a.centre, Vec3(5, 1, 0));
  EXPECT_EQ(a.model_per_scene, b.model_per_scene);
  EXPECT_EQ(a.framed, b.framed);
  EXPECT_EQ(a.framed.size(), extent.size());
  const double moved = (wide(b.positions[0]) - wide(a.positions[0])).norm();
  EXPECT_NEAR(moved * a.model_per_scene, 9, 9 * kSceneRounding);
}

TEST(PictureOfAFrame, KeepsTheScaleOfAnotherFrame) {
  const MeshPtr mesh = finish({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  PictureData data = picture_of(*mesh);
  add_distances(data, std::vector<double>{0, 1, 4}, 2.0);
  EXPECT_EQ(data.values, (std::vector<float>{0, 0.5, 2}));
  EXPECT_EQ(picture_scale(data, PictureSettings()).max, 2);
  add_distances(data, std::vector<double>{0, 0, 0}, 2.0);
  EXPECT_EQ(picture_scale(data, PictureSettings()).max, 2);
}

TEST(PictureSceneOf, PointsWithoutFacesDoNotCount) {
  Draft draft = sphere(1);
  const PictureData before = picture_of(*finish(draft));
  draft.add({1e9, 0, 0});
  const PictureData after = picture_of(*finish(draft));
  EXPECT_EQ(after.model_per_scene, before.model_per_scene);
  EXPECT_EQ(after.positions[0], before.positions[0]);
  EXPECT_LE(wide(after.positions.back()).norm(), 1 + kSceneRounding);
}

TEST(PictureValues, AreSharesOfTheLargestDistance) {
  PictureData data;
  app::add_distances(data, std::vector<double>{0, 2e200, 4e200, kUnreached});
  EXPECT_EQ(data.values, (std::vector<float>{0, 0.5F, 1, kNoPictureValue}));
  EXPECT_EQ(data.value_unit, 4e200);
  EXPECT_EQ(data.largest_value, 1);
}

TEST(PictureValues, OfNoFiniteDistanceAreNone) {
  PictureData data;
  app::add_distances(data, std::vector<double>{kUnreached, kUnreached});
  EXPECT_EQ(data.values, (std::vector<float>{kNoPictureValue, kNoPictureValue}));
  EXPECT_EQ(data.value_unit, 1);
  EXPECT_EQ(data.largest_value, 0);
  const PictureScale scale = picture_scale(data, {});
  EXPECT_LT(scale.min, scale.max);
  EXPECT_EQ(scale.spacing, 0);
  EXPECT_FALSE(scale.bar);
}

TEST(PictureSources, ArePointsAndPiecesOfCurves) {
  const MeshPtr mesh = finish(plane_grid(2, 2, 2, 2));
  SourceSet sources = SourceSet::of_vertices({0, 1, 8});
  sources.edges.push_back({0, 1});
  sources.points.push_back(SurfacePoint::in_face(0, {0.5, 0.25, 0.25}));
  PictureData data = picture_of(*mesh);
  app::add_sources(data, *mesh, sources);
  ASSERT_EQ(data.sources.size(), 3U);  // the ends of the edge are part of it
  EXPECT_EQ(data.sources[0].from, data.positions[0]);
  EXPECT_EQ(data.sources[0].to, data.positions[1]);
  EXPECT_EQ(data.sources[1].from, data.positions[8]);
  EXPECT_EQ(data.sources[1].to, data.positions[8]);
  const auto& [a, b, c] = data.faces[0];
  const Vec3 inside = 0.5 * wide(data.positions[a]) + 0.25 * wide(data.positions[b]) +
                      0.25 * wide(data.positions[c]);
  EXPECT_LE((wide(data.sources[2].from) - inside).norm(), kSceneRounding);
}

TEST(PictureSources, OfASolidKnowWhichWayItsFacesLook) {
  const MeshPtr mesh = finish(sphere(3));
  SourceSet sources = SourceSet::of_vertices({17});
  sources.points.push_back(SurfacePoint::in_face(3, {0.5, 0.25, 0.25}));
  PictureData data = picture_of(*mesh);
  app::add_sources(data, *mesh, sources);
  EXPECT_EQ(data.sources[0].outward, app::kAllAround) << "it may be open";
  data.solid = true;
  app::add_sources(data, *mesh, sources);
  for (const PictureData::Segment& source : data.sources) {
    const auto& [x, y, z, w] = source.outward;
    EXPECT_GT(Vec3(x, y, z).dot(wide(source.from).normalized()), 0.98);
    EXPECT_LT(w, 0.3);
  }
  EXPECT_GT(data.sources[0].outward[3], 0.01F) << "its faces look different ways";
  EXPECT_LT(data.sources[1].outward[3], 1e-6F) << "of one face";
}

TEST(PictureFields, KeepTheHeatsDirectionWhereHeatUnderflows) {
  constexpr Index kLength = 2000;
  const MeshPtr strip = finish(plane_grid(kLength, 2, kLength, 2));
  const auto method = HeatMethod::build(strip);
  ASSERT_TRUE(method) << method.error().message;
  QueryOptions query;
  query.fields = true;
  const auto result = method->solve(SourceSet::of_vertices({grid_vertex(kLength, 0, 1)}), query);
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->heat[grid_vertex(kLength, kLength, 1)], 0);
  PictureData data = picture_of(*strip);
  app::add_fields(data, *strip, *result);
  // Away from the source's surroundings and the strip's end heat flows along it.
  constexpr double kStraight = 1e-3;
  for (Index f = 0; f < strip->face_count(); ++f) {
    const Index column = f / 2 % kLength;
    if (column < 100 || column > kLength - 100) continue;
    ASSERT_LE((wide(data.heat_directions[f]) - Vec3(1, 0, 0)).norm(), kStraight) << f;
    ASSERT_LE(wide(data.distance_gradients[f]).norm(), kStraight) << f;
  }
}

TEST(PictureFields, HaveTheLengthOfTheAngleBetweenThem) {
  const MeshPtr mesh = finish({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const auto length_at = [&](double degrees) {
    constexpr double kRadian = 3.14159265358979323846 / 180;
    DistanceResult result;
    result.log_heat = {0, -1, 0};  // falls along x: X = (1, 0, 0)
    result.distances = {0, std::cos(degrees * kRadian), std::sin(degrees * kRadian)};
    PictureData data = picture_of(*mesh);
    app::add_fields(data, *mesh, result);
    EXPECT_LE((wide(data.heat_directions[0]) - Vec3(1, 0, 0)).norm(), kSceneRounding);
    return wide(data.distance_gradients[0]).norm();
  };
  EXPECT_NEAR(length_at(0), 0, kSceneRounding);
  EXPECT_NEAR(length_at(9), 0.1, kSceneRounding);
  EXPECT_NEAR(length_at(45), 0.5, kSceneRounding);
  EXPECT_NEAR(length_at(90), 1, kSceneRounding);
  EXPECT_NEAR(length_at(150), 1, kSceneRounding);
}

TEST(PictureFields, AreZeroWhereNothingIsReachedOrThereIsNoArea) {
  Draft draft = plane_grid(3, 3, 1, 1);
  const Index reached = static_cast<Index>(draft.faces.size());
  append(draft, transformed(plane_grid(1, 1, 1, 1), 1, {5, 0, 0}, false));
  draft.faces.push_back({0, 0, 1});
  const MeshPtr mesh = finish(draft);
  const auto method = HeatMethod::build(mesh);
  ASSERT_TRUE(method) << method.error().message;
  QueryOptions query;
  query.fields = true;
  const auto result = method->solve(SourceSet::of_vertices({0}), query);
  ASSERT_TRUE(result) << result.error().message;
  PictureData data = picture_of(*mesh);
  app::add_fields(data, *mesh, *result);
  ASSERT_EQ(data.heat_directions.size(), static_cast<std::size_t>(mesh->face_count()));
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const double length = wide(data.heat_directions[f]).norm();
    EXPECT_NEAR(length, f < reached ? 1 : 0, kSceneRounding) << f;
    if (f < reached) continue;
    EXPECT_EQ(wide(data.distance_gradients[f]), Vec3::Zero()) << f;
  }
}

TEST(HeatDirection, IsThatOfTheHeatWhateverFactorItHas) {
  const MeshPtr mesh = finish(sphere(2));
  std::vector<double> near, far;
  for (const Vec3& p : mesh->positions()) {
    near.push_back(std::log(2 + p[0]));
    far.push_back(near.back() - 50'000);
  }
  const std::vector<Vec3> expected = heat_directions(*mesh, near);
  const std::vector<Vec3> actual = heat_directions(*mesh, far);
  // The logarithm of a number of 20,000 digits keeps ten of its own.
  constexpr double kDigitsLeft = 1e-9;
  for (std::size_t f = 0; f < expected.size(); ++f) {
    ASSERT_NEAR(expected[f].norm(), 1, kSceneRounding);
    ASSERT_LE((expected[f] - actual[f]).norm(), kDigitsLeft);
  }
}

TEST(PictureScaleOf, TheSettingsGoesBeforeThatOfTheData) {
  PictureData data;
  app::add_distances(data, std::vector<double>{0, 4});
  PictureSettings settings;
  const PictureScale own = picture_scale(data, settings);
  EXPECT_EQ(own.min, 0);
  EXPECT_EQ(own.max, 4);
  EXPECT_EQ(own.spacing, 0.2);
  EXPECT_TRUE(own.bar);
  settings.range_min = 1;
  settings.range_max = 9;
  settings.line_spacing = 0.75;
  const PictureScale given = picture_scale(data, settings);
  EXPECT_EQ(given.min, 1);
  EXPECT_EQ(given.max, 9);
  EXPECT_EQ(given.spacing, 0.75);
  settings.bar = false;
  EXPECT_FALSE(picture_scale(data, settings).bar);
  settings.bar = true;
  settings.view = app::View::kSmooth;
  EXPECT_FALSE(picture_scale(data, settings).bar);
}

TEST(PictureScaleOf, IsolinesCloserThanPixelsHasNone) {
  PictureData data;
  app::add_distances(data, std::vector<double>{0, 4});
  PictureSettings settings;
  settings.width = settings.height = 100;
  settings.line_spacing = 0.05;  // 80 lines
  EXPECT_EQ(picture_scale(data, settings).spacing, 0.05);
  settings.line_spacing = 0.03;  // 133
  EXPECT_EQ(picture_scale(data, settings).spacing, 0);
  EXPECT_TRUE(picture_scale(data, settings).coloured);
}

TEST(Solids, AreClosedAndTurnedOutwards) {
  const auto solid = [](const Draft& draft) {
    const MeshPtr mesh = finish(draft);
    return app::is_solid(*mesh);
  };
  Draft ball = sphere(2);
  EXPECT_TRUE(solid(ball));
  EXPECT_TRUE(solid(transformed(ball, 1e200, Vec3(1e201, 0, 0), true)));
  Draft inside_out = ball;
  for (Face& face : inside_out.faces) std::swap(face[0], face[1]);
  EXPECT_FALSE(solid(inside_out));
  Draft mixed = ball;
  std::swap(mixed.faces[5][0], mixed.faces[5][1]);
  EXPECT_FALSE(solid(mixed));
  Draft open = ball;
  open.faces.pop_back();
  EXPECT_FALSE(solid(open));
  EXPECT_FALSE(solid(moebius(20, 3)));
  Draft two = ball;
  append(two, transformed(ball, 0.01, Vec3(2, 0, 0), false));
  EXPECT_TRUE(solid(two));
  append(two, transformed(inside_out, 0.01, Vec3(3, 0, 0), false));
  EXPECT_FALSE(solid(two)) << "one is inside out";
}

TEST(PictureScaleOf, AnEndBeyondAllDistancesIsARangeAllTheSame) {
  PictureData data;
  app::add_distances(data, std::vector<double>{0, 4});
  PictureSettings settings;
  settings.range_min = 100;
  EXPECT_LT(picture_scale(data, settings).min, picture_scale(data, settings).max);
  settings.range_min.reset();
  settings.range_max = -100;
  EXPECT_LT(picture_scale(data, settings).min, picture_scale(data, settings).max);
}

}  // namespace
}  // namespace geotherm::test
