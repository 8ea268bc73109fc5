// SPDX-License-Identifier: MIT
// Closed paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <string_view>

#include "solver/mesh/connectivity.h"
#include "tests/path/path_support.h"

namespace geotherm::test {
namespace {

constexpr double kLoopRounded = 1e-12;
constexpr PathOptions kLoop{PathField::kGeodesic, true, false};
constexpr PathOptions kHeld{PathField::kGeodesic, true, true};

/// Surface of revolution: radius(z) for z from -1 to 1, open at both ends.
template <class Radius>
Draft revolved(Index around, Index along, Radius&& radius) {
  Draft draft = prism(around, along, 2);
  for (Index j = 0; j <= along; ++j) {
    const double z = 2.0 * j / along - 1;
    for (Index i = 0; i < around; ++i) {
      const double u = 2 * std::numbers::pi * i / around;
      draft.positions[static_cast<std::size_t>(j * around + i)] = {radius(z) * std::cos(u),
                                                                   radius(z) * std::sin(u), z};
    }
  }
  return draft;
}

std::vector<SurfacePoint> vertices(const std::vector<Index>& ids) {
  std::vector<SurfacePoint> out;
  for (const Index v : ids) out.push_back(vertex(v));
  return out;
}

TEST(Loop, RoundACylinderHasItsPerimeter) {
  const PathFinder finder = finder_on(finish(prism(15, 8, 1)));
  const SurfacePath path = found(finder, vertices({2, 5 * 15 + 7, 3 * 15 + 12}), kLoop);
  EXPECT_TRUE(path.closed);
  EXPECT_NEAR(path.length, 1.0, kLoopRounded);
}

TEST(Loop, SlidesToTheThroatOfASleeve) {
  constexpr Index kAround = 24, kAlong = 20;
  const PathFinder finder =
      finder_on(finish(revolved(kAround, kAlong, [](double z) { return 0.3 + 0.5 * z * z; })));
  const SurfacePath path =
      found(finder, vertices({3 * kAround, 5 * kAround + 8, 2 * kAround + 16}), kLoop);
  const double throat = kAround * 2 * 0.3 * std::sin(std::numbers::pi / kAround);
  EXPECT_NEAR(path.length, throat, kLoopRounded);
}

TEST(Loop, RoundATorusShrinksToItsHole) {
  constexpr Index kAround = 30, kAcross = 16;
  const Draft draft = torus(kAround, kAcross, 0.4);
  Index top[3] = {0, 0, 0};  // the highest vertices a third of the way round from each other
  for (int third = 0; third < 3; ++third) {
    const double u = 2 * std::numbers::pi * third / 3;
    double best = -1e9;
    for (std::size_t v = 0; v < draft.positions.size(); ++v) {
      const Vec3& p = draft.positions[v];
      const double score = p.z() + (p.x() * std::cos(u) + p.y() * std::sin(u)) / p.head<2>().norm();
      if (score > best) {
        best = score;
        top[third] = static_cast<Index>(v);
      }
    }
  }
  const SurfacePath path =
      found(finder_on(finish(draft)), vertices({top[0], top[1], top[2]}), kLoop);
  const double hole = kAround * 2 * 0.6 * std::sin(std::numbers::pi / kAround);
  EXPECT_NEAR(path.length, hole, kLoopRounded);
}

TEST(Loop, OnASphereIsDrawnTogetherToAPointAndSaysSo) {
  const PathFinder finder = finder_on(finish(sphere(3)));
  const auto loop = finder.find(vertices({12, 40, 99}), kLoop);
  ASSERT_TRUE(loop) << loop.error().message;
  EXPECT_EQ(loop->path.length, 0);
  EXPECT_EQ(loop->path.points.size(), 1U);
  EXPECT_EQ(loop->warnings.size(), 1U);
}

TEST(Loop, HeldByItsPointsIsTheTriangleOnAPlane) {
  const PathFinder finder = finder_on(finish(plane_grid(4, 4, 1, 1)));
  const auto corners = vertices({0, grid_vertex(4, 4, 0), grid_vertex(4, 0, 4)});
  const SurfacePath path = found(finder, corners, kHeld);
  EXPECT_NEAR(path.length, 2 + std::sqrt(2.0), kLoopRounded);
  EXPECT_TRUE(path.closed);
  EXPECT_EQ(path.points.front().vertex, path.points.back().vertex);
}

TEST(Loop, RoundTheMiddleOfAMoebiusStripIsShorterThanItsRim) {
  const MeshPtr mesh = finish(moebius(40, 6));
  const PathFinder finder = finder_on(mesh);
  const auto points = vertices({3, 3 + 7 * 13, 3 + 7 * 26});
  const SurfacePath held = found(finder, points, kHeld);
  const SurfacePath loop = found(finder, points, kLoop);
  EXPECT_LE(loop.length, held.length);
  double rim = 0;  // runs round twice
  const EdgeTable edges(mesh->vertex_count(), mesh->faces());
  for (Index e = 0; e < edges.edge_count(); ++e) {
    if (edges.sides(e).size() != 1) continue;
    rim += (mesh->positions()[edges.low(e)] - mesh->positions()[edges.high(e)]).norm();
  }
  EXPECT_GT(loop.length, 0.4 * rim);  // round, not drawn together
  EXPECT_LT(loop.length, 0.5 * rim);
}

TEST(Loop, SharesOfTheProgressDoNotFall) {
  const PathFinder finder = finder_on(finish(prism(15, 8, 1)));
  double last = 0;
  const auto path = finder.find(vertices({2, 5 * 15 + 7, 3 * 15 + 12}), kLoop,
                                [&](std::string_view stage, double share) {
                                  EXPECT_TRUE(share < 0 || share >= last) << stage;
                                  last = std::max(last, share);
                                  return true;
                                });
  EXPECT_TRUE(path) << path.error().message;
  EXPECT_LE(last, 1);
}

TEST(Loop, WithoutMemoryIsAnErrorNotAnException) {
  const PathFinder finder = finder_on(finish(prism(15, 8, 1)));
  const auto path = finder.find(vertices({2, 5 * 15 + 7, 3 * 15 + 12}), kLoop,
                                [](std::string_view stage, double) {
                                  if (stage == "shortening the path") throw std::bad_alloc();
                                  return true;
                                });
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, ErrorCode::kOutOfMemory) << path.error().message;
}

}  // namespace
}  // namespace geotherm::test
