// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geotherm/path.h"
#include "solver/mesh/closest_point_tree.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// Of a handful of operations on numbers of the triangle's size.
constexpr double kPointRoundOff = 1e-14;

/// Corners (0,0,0), (4,0,0), (0,4,0).
TriangleMesh one_triangle() {
  return *TriangleMesh::build({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)}, {{0, 1, 2}});
}

struct PlaceCase {
  const char* name;
  Vec3 query, closest;
};

class ClosestPoints : public testing::TestWithParam<PlaceCase> {};

TEST_P(ClosestPoints, AreFoundInFacesOnSidesAndAtCorners) {
  const TriangleMesh mesh = one_triangle();
  const auto found = closest_point(mesh, GetParam().query);
  ASSERT_TRUE(found);
  EXPECT_LE((position_at(mesh, found->point) - GetParam().closest).norm(), 4 * kPointRoundOff);
  EXPECT_NEAR(found->distance, (GetParam().query - GetParam().closest).norm(), 10 * kPointRoundOff);
}

INSTANTIATE_TEST_SUITE_P(OfATriangle, ClosestPoints,
                         testing::Values(PlaceCase{"Above", {1, 1, 3}, {1, 1, 0}},
                                         PlaceCase{"Below", {1, 1, -3}, {1, 1, 0}},
                                         PlaceCase{"On", {1, 2, 0}, {1, 2, 0}},
                                         PlaceCase{"BesideTheFirst", {1, -2, 1}, {1, 0, 0}},
                                         PlaceCase{"BesideTheSecond", {4, 4, 0}, {2, 2, 0}},
                                         PlaceCase{"BesideTheThird", {-5, 3, 2}, {0, 3, 0}},
                                         PlaceCase{"AtTheFirst", {-1, -1, 0}, {0, 0, 0}},
                                         PlaceCase{"AtTheSecond", {9, -1, 2}, {4, 0, 0}},
                                         PlaceCase{"AtTheThird", {-1, 7, 0}, {0, 4, 0}}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(ClosestPoint, IsAVertexWhereTheQueryIsOne) {
  const MeshPtr mesh = finish(sphere(2));
  for (const Index v : {0, 7, 100}) {
    const auto found = closest_point(*mesh, mesh->positions()[static_cast<std::size_t>(v)]);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->point.vertex, v);
    EXPECT_EQ(found->distance, 0.0);
  }
}

TEST(ClosestPoint, IsNoFartherThanAnyVertexAndHasValidWeights) {
  const MeshPtr mesh = finish(torus(24, 12, 0.4));
  for (int i = 0; i < 50; ++i) {
    const Vec3 query(std::sin(3.0 * i), 2 * std::cos(5.0 * i), std::sin(7.0 * i));
    const auto found = closest_point(*mesh, query);
    ASSERT_TRUE(found);
    for (const Vec3& p : mesh->positions()) EXPECT_LE(found->distance, (p - query).norm() * 1.0001);
    if (found->point.is_vertex()) continue;
    double sum = 0;
    for (const double w : found->point.weights) {
      EXPECT_GE(w, 0);
      sum += w;
    }
    EXPECT_NEAR(sum, 1, kPointRoundOff);
  }
}

TEST(ClosestPoint, TakesFacesWithoutAreaAsSegmentsAndPoints) {
  // A face that is a segment, a face that is one point, and a face that repeats a corner.
  const auto mesh =
      *TriangleMesh::build({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(5, 5, 5),
                            Vec3(5, 5, 5), Vec3(5, 5, 5), Vec3(9, 9, 9)},
                           {{0, 1, 2}, {3, 4, 5}, {6, 6, 0}});
  const auto segment = closest_point(mesh, Vec3(0.5, 1, 0));
  ASSERT_TRUE(segment);
  EXPECT_NEAR(segment->distance, 1, kPointRoundOff);
  const auto point = closest_point(mesh, Vec3(9, 9, 9));
  ASSERT_TRUE(point);
  EXPECT_EQ(point->point.vertex, 3);
}

TEST(ClosestPoint, IsTheSameAtEveryScale) {
  for (const double scale : {1e-200, 1e-9, 1e9, 1e200}) {
    const MeshPtr mesh = finish(transformed(plane_grid(3, 3, 1, 1), scale, Vec3::Zero(), false));
    const auto found = closest_point(*mesh, scale * Vec3(0.4, 0.45, 0.5));
    ASSERT_TRUE(found) << scale;
    EXPECT_NEAR(found->distance / scale, 0.5, kPointRoundOff) << scale;
  }
}

TEST(ClosestPoint, IsTheSameByATreeToTheLastBitAlsoAmongEquals) {
  for (const double scale : {1e-200, 1.0, 1e9, 1e200}) {
    for (const Draft& shape : {torus(24, 12, 0.4), plane_grid(9, 9, 1, 1), sphere(2)}) {
      const MeshPtr mesh = finish(transformed(shape, scale, Vec3(3, -2, 5) * scale, false));
      const auto tree = ClosestPointTree::build(*mesh, {});
      ASSERT_TRUE(tree);
      const auto compare = [&](const Vec3& query) {
        const auto one = closest_point(*mesh, query), other = tree->to(query);
        ASSERT_TRUE(one && other);
        EXPECT_EQ(other->point, one->point) << scale << ": " << query.transpose();
        EXPECT_EQ(other->distance, one->distance) << scale << ": " << query.transpose();
      };
      for (int i = 0; i < 60; ++i) {
        const Vec3 about(std::sin(3.0 * i), 2 * std::cos(5.0 * i), std::sin(7.0 * i));
        compare(scale * (Vec3(3, -2, 5) + about * std::pow(10.0, i % 5)));
        compare(scale * about * 1e8);
      }
      for (const Vec3& p : mesh->positions()) compare(p);  // several faces are as near
      compare(scale * Vec3(3, -2, 5));                     // the middle: all are
      for (int i = 0; i < 9; ++i) compare(scale * Vec3(i, i, 7) / 8);
    }
  }
}

TEST(ClosestPoint, OfATreeIsCancelledAndRefusesWhatHasNone) {
  const MeshPtr mesh = finish(sphere(4));
  const auto cancelled =
      ClosestPointTree::build(*mesh, [](std::string_view, double) { return false; });
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
  const auto none = *TriangleMesh::build({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {{0, 0, 1}});
  const auto tree = ClosestPointTree::build(none, {});
  ASSERT_TRUE(tree);
  EXPECT_EQ(sentence(tree->to(Vec3::Zero()).error()),
            sentence(closest_point(none, Vec3::Zero()).error()));
  EXPECT_FALSE(tree->to(Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0)));
}

TEST(ClosestPoint, RefusesWhatHasNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(closest_point(one_triangle(), Vec3(0, nan, 0)).error().code, ErrorCode::kBadInput);
  const auto mesh = *TriangleMesh::build({Vec3(0, 0, 0), Vec3(1, 0, 0)}, {{0, 0, 1}});
  EXPECT_NE(sentence(closest_point(mesh, Vec3::Zero()).error()).find("1 faces"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
