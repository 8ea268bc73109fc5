// SPDX-License-Identifier: MIT
// Geodesics where the shortest path is known, and on every mesh of the zoo.
#include "geotherm/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

#include "solver/path/shorten.h"
#include "solver/path/streamline.h"
#include "tests/path/path_support.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/sanitized.h"

namespace geotherm::test {
namespace {

/// Lengths of straight paths are exact but for the round-off of a few hundred sums.
constexpr double kRounded = 1e-12;

TEST(Geodesic, IsTheStraightLineOnAPlane) {
  const MeshPtr mesh = finish(jittered_plane(20, 0.3, 3));
  const PathFinder finder = finder_on(mesh);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.05, 0.45);
  for (int i = 0; i < (kSanitized ? 5 : 20); ++i) {
    const auto place = [&] {
      const double a = share(random), b = share(random);
      return SurfacePoint::in_face(static_cast<Index>(random() % 800), {a, b, 1 - a - b});
    };
    const std::vector<SurfacePoint> ends = {place(), place()};
    const SurfacePath path = found(finder, ends);
    const double straight = (position_at(*mesh, ends[1]) - position_at(*mesh, ends[0])).norm();
    EXPECT_NEAR(path.length, straight, kRounded);
  }
}

TEST(Geodesic, CrossesTheSidesOfACubeAsTheirNetSays) {
  Draft cube;
  for (const double z : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double x : {0.0, 1.0}) cube.add({x, y, z});
    }
  }
  cube.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const PathFinder finder = finder_on(finish(cube));
  EXPECT_NEAR(found(finder, 0, 7).length, std::sqrt(5.0), kRounded);
  EXPECT_NEAR(found(finder, 1, 6).length, std::sqrt(5.0), kRounded);
  EXPECT_NEAR(found(finder, 0, 3).length, std::sqrt(2.0), kRounded);
  EXPECT_NEAR(found(finder, 0, 1).length, 1.0, kRounded);
}

TEST(Geodesic, IsAHelixOnACylinder) {
  constexpr Index kAround = 24;
  const PathFinder finder = finder_on(finish(prism(kAround, 12, 0.8)));
  for (const Index around : {1, 5, 9, 11, 17}) {
    const double turn = std::min(around, kAround - around) / static_cast<double>(kAround);
    const SurfacePath path = found(finder, 0, 12 * kAround + around);
    EXPECT_NEAR(path.length, std::hypot(turn, 0.8), kRounded) << around;
  }
}

TEST(Geodesic, GoesRoundTheApexOfACone) {
  // 6 sectors of 0.4: opposite corners are 1.2 apart about the apex, in the unrolled cone.
  const PathFinder finder = finder_on(finish(pyramid(6, 8, 0.4)));
  const Index ring = 1 + 6 * (1 + 2 + 3 + 4 + 5 + 6 + 7);  // the first vertex of ring 8
  EXPECT_NEAR(found(finder, ring, ring + 3 * 8).length, 2 * std::sin(0.6), kRounded);
  EXPECT_NEAR(found(finder, ring, ring + 8).length, 2 * std::sin(0.2), kRounded);
}

TEST(Geodesic, GoesThroughASaddle) {
  constexpr Index kSectors = 12;
  Draft saddle;
  saddle.add({0, 0, 0});
  for (Index s = 0; s < kSectors; ++s) {
    const double u = 2 * std::numbers::pi * s / kSectors;
    saddle.add({std::cos(u), std::sin(u), s % 2 == 0 ? 1.0 : -1.0});
  }
  for (Index s = 0; s < kSectors; ++s) saddle.faces.push_back({0, 1 + s, 1 + (s + 1) % kSectors});
  const SurfacePath path = found(finder_on(finish(saddle)), 1, 7);
  EXPECT_NEAR(path.length, 2 * std::sqrt(2.0), kRounded);
  ASSERT_EQ(path.points.size(), 3U);
  EXPECT_EQ(path.points[1].vertex, 0);
}

TEST(Geodesic, BendsAtTheInnerCornerOfABorder) {
  Draft draft = plane_grid(8, 8, 2, 2);
  std::erase_if(draft.faces, [&](const Face& f) {
    double x = 0, y = 0;
    for (const Index v : f) {
      x += draft.positions[static_cast<std::size_t>(v)].x() / 3;
      y += draft.positions[static_cast<std::size_t>(v)].y() / 3;
    }
    return x > 1 && y > 1;
  });
  const SurfacePath path =
      found(finder_on(finish(draft)), grid_vertex(8, 8, 3), grid_vertex(8, 3, 8));
  EXPECT_NEAR(path.length, 2 * std::hypot(1, 0.25), kRounded);
}

TEST(Geodesic, TakesThePagesOfABookThatItsEndsAreOn) {
  Draft book;
  for (const Vec3& away : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-0.6, -0.8, 0)}) {
    for (Index i = 0; i <= 4; ++i) {
      for (Index j = 0; j < 4; ++j) book.add((j + 1) / 4.0 * away + Vec3(0, 0, i / 4.0));
    }
  }
  const Index spine = book.vertex_count();
  for (Index i = 0; i <= 4; ++i) book.add({0, 0, i / 4.0});
  for (Index page = 0; page < 3; ++page) {
    const auto at = [&](Index i, Index j) {
      return j == 0 ? spine + i : page * 20 + i * 4 + j - 1;
    };
    for (Index i = 0; i < 4; ++i) {
      for (Index j = 0; j < 4; ++j) {
        book.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        book.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  const PathFinder finder = finder_on(finish(book));
  const auto outer = [](Index page, Index i) { return page * 20 + i * 4 + 3; };
  for (Index page = 0; page < 3; ++page) {
    const SurfacePath path = found(finder, outer(page, 0), outer((page + 1) % 3, 3));
    EXPECT_NEAR(path.length, std::hypot(2, 0.75), kRounded) << page;
  }
}

TEST(Geodesic, InOneFaceIsOnePiece) {
  const MeshPtr mesh = finish(sphere(1));
  const PathFinder finder = finder_on(mesh);
  const SurfacePath path = found(finder, {SurfacePoint::in_face(5, {0.2, 0.3, 0.5}),
                                          SurfacePoint::in_face(5, {0.6, 0.3, 0.1})});
  ASSERT_EQ(path.points.size(), 2U);
  EXPECT_EQ(path.faces, std::vector<Index>{5});
}

TEST(Geodesic, BetweenNeighboursOfAConvexMeshIsTheirEdge) {
  const MeshPtr mesh = finish(sphere(2));
  const PathFinder finder = finder_on(mesh);
  const auto [a, b, c] = mesh->faces()[7];
  const double edge = (mesh->positions()[a] - mesh->positions()[b]).norm();
  EXPECT_NEAR(found(finder, a, b).length, edge, kRounded);
}

TEST(Geodesic, FromAPointToItselfIsThatPoint) {
  const PathFinder finder = finder_on(finish(sphere(1)));
  const SurfacePoint inside = SurfacePoint::in_face(3, {0.25, 0.25, 0.5});
  for (const SurfacePoint& point : {vertex(4), inside}) {
    const SurfacePath path = found(finder, {point, point});
    EXPECT_EQ(path.length, 0);
    EXPECT_EQ(path.points.size(), 1U);
  }
}

TEST(Geodesic, BetweenComponentsIsRefused) {
  Draft draft = sphere(1);
  append(draft, transformed(sphere(1), 1, Vec3(5, 0, 0), false));
  const PathFinder finder = finder_on(finish(draft));
  for (const char* field : {"geodesic", "distance"}) {
    const std::vector<SurfacePoint> ends = {vertex(0), vertex(60)};
    const auto path = finder.find(ends, {*parse<PathField>(field), false, false});
    ASSERT_FALSE(path);
    EXPECT_EQ(path.error().code, ErrorCode::kBadInput);
  }
}

TEST(Geodesic, RefusesPointsThatAreNotOnTheMesh) {
  const PathFinder finder = finder_on(finish(sphere(1)));
  const SurfacePoint bad[] = {vertex(-1),
                              vertex(9999),
                              SurfacePoint::in_face(9999, {1, 0, 0}),
                              SurfacePoint::in_face(0, {0.5, 0.5, 0.5}),
                              SurfacePoint::in_face(0, {-0.5, 0.5, 1}),
                              SurfacePoint::in_face(0, {NAN, 0.5, 0.5})};
  for (const SurfacePoint& point : bad) {
    const std::vector<SurfacePoint> ends = {vertex(0), point};
    const auto path = finder.find(ends);
    ASSERT_FALSE(path);
    EXPECT_EQ(path.error().code, ErrorCode::kBadInput);
  }
  const std::vector<SurfacePoint> one = {vertex(0)};
  EXPECT_FALSE(finder.find(one));
}

TEST(Geodesic, AcceptsWeightsThatAreRoundedLikeThoseOfASource) {
  const PathFinder finder = finder_on(finish(sphere(1)));
  const SurfacePoint on_edge = SurfacePoint::in_face(0, {0.5, 0.5, 0});
  const SurfacePoint rounded = SurfacePoint::in_face(0, {0.5 + 6e-7, 0.5, -9e-7});
  EXPECT_NEAR(found(finder, {rounded, vertex(9)}).length,
              found(finder, {on_edge, vertex(9)}).length, 1e-6);
  const std::vector<SurfacePoint> off = {SurfacePoint::in_face(0, {0.5, 0.500002, -2e-6}),
                                         vertex(9)};
  EXPECT_FALSE(finder.find(off));
}

TEST(Geodesic, IsTheSameAtAnyScaleAndPlace) {
  const Draft draft = torus(20, 12, 0.4);
  const double length = found(finder_on(finish(draft)), 3, 130).length;
  for (const double scale : {1e-150, 1e-9, 1e6, 1e120}) {
    const MeshPtr mesh = finish(transformed(draft, scale, Vec3(3, -2, 1) * scale, true));
    EXPECT_NEAR(found(finder_on(mesh), 3, 130).length / scale, length, 1e-9 * length) << scale;
  }
}

TEST(Geodesic, PassesThroughItsWayPoints) {
  const PathFinder finder = finder_on(finish(plane_grid(6, 6, 1, 1)));
  const SurfacePath path =
      found(finder, {vertex(0), vertex(grid_vertex(6, 6, 0)), vertex(grid_vertex(6, 6, 6))});
  EXPECT_NEAR(path.length, 2.0, kRounded);
}

class GeodesicOn : public testing::TestWithParam<ZooMesh> {};

/// Symmetric, never longer than along edges, and nothing left to shorten.
TEST_P(GeodesicOn, IsSoundBetweenAnyTwoPoints) {
  const MeshPtr mesh = GetParam().mesh();
  const PathFinder finder = finder_on(mesh);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> share(0, 0.5);
  for (int i = 0; i < (kSanitized ? 2 : 6); ++i) {
    const auto place = [&](bool bare) {
      if (bare) return vertex(static_cast<Index>(random() % mesh->positions().size()));
      const double a = share(random), b = share(random);
      return SurfacePoint::in_face(static_cast<Index>(random() % mesh->faces().size()),
                                   {a, b, 1 - a - b});
    };
    const std::vector<SurfacePoint> ends = {place(i % 2 == 0), place(i % 3 == 0)};
    const auto path = finder.find(ends);
    const auto along_edges = edge_path(finder.surface(), ends[0], ends[1]);
    ASSERT_EQ(path.has_value(), along_edges.has_value());
    if (!path) {
      EXPECT_EQ(path.error().code, ErrorCode::kBadInput) << path.error().message;
      continue;
    }
    EXPECT_TRUE(is_path(*mesh, path->path));
    EXPECT_LE(path->path.length, along_edges->length * (1 + kRounded));
    const std::vector<SurfacePoint> turned = {ends[1], ends[0]};
    EXPECT_NEAR(found(finder, turned).length, path->path.length, kRounded * path->path.length);
    const auto again = shorten(finder.surface(), path->path);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_NEAR(again->length, path->path.length, 1e-9 * path->path.length);
    if ((GetParam().tags & kPlanar) != 0 && (GetParam().tags & kBorder) != 0) {
      const double straight = (position_at(*mesh, ends[1]) - position_at(*mesh, ends[0])).norm();
      EXPECT_GE(path->path.length, straight * (1 - kRounded));
    }
  }
}

/// The meshes whose name is, or is not, this one's: its paths of thousands of faces take long.
std::vector<ZooMesh> meshes_where(bool is_long) {
  std::vector<ZooMesh> out;
  for (const ZooMesh& mesh : zoo()) {
    if ((std::string_view(mesh.name) == "long_strip") == is_long) out.push_back(mesh);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Zoo, GeodesicOn, testing::ValuesIn(meshes_where(false)), zoo_name);
INSTANTIATE_TEST_SUITE_P(ZooSlow, GeodesicOn, testing::ValuesIn(meshes_where(true)), zoo_name);

}  // namespace
}  // namespace geotherm::test
