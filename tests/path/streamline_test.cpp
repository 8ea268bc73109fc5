// SPDX-License-Identifier: MIT
// Streamlines of distance and heat.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/path/streamline.h"
#include "tests/path/path_support.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

constexpr PathOptions kDistance{PathField::kDistance, false, false};
constexpr PathOptions kHeat{PathField::kHeat, false, false};

TEST(Streamline, OfALinearFunctionIsStraight) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 5));
  const PathSurface surface(mesh);
  std::vector<double> height;
  for (const Vec3& p : mesh->positions()) height.push_back(p.x());
  const SurfacePoint start = SurfacePoint::in_face(150, {0.3, 0.3, 0.4});
  const auto line = trace_streamline(surface, {height}, start, vertex(0));
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_TRUE(line->stuck);  // at the border x = 0, of which vertex 0 is but one point
  const double y = position_at(*mesh, start).y();
  for (const Vec3& p : positions_of(*mesh, line->path)) {
    if (p.x() > 1e-9) {
      EXPECT_NEAR(p.y(), y, 1e-12);
    }
  }
}

TEST(Streamline, OfDistanceAndHeatIsNearlyAsShortAsTheGeodesic) {
  const MeshPtr mesh = finish(sphere(4));
  const PathFinder finder = finder_on(mesh, MethodKind::kHeat);
  const double shortest = found(finder, 17, 1234).length;
  constexpr double kCoarse = 1.05;  // gradients of a mesh with edges of a twentieth of the radius
  for (const PathOptions& options : {kDistance, kHeat}) {
    const SurfacePath path = found(finder, 17, 1234, options);
    EXPECT_GE(path.length, shortest * (1 - 1e-12));
    EXPECT_LE(path.length, shortest * kCoarse);
    EXPECT_EQ(path.points.front().vertex, 17);
    EXPECT_EQ(path.points.back().vertex, 1234);
  }
}

TEST(Streamline, OfHeatIsFollowedWhereHeatUnderflows) {
  const PathFinder finder = finder_on(finish(plane_grid(600, 2, 600, 2)), MethodKind::kHeat);
  const auto path = finder.find(std::vector{vertex(0), vertex(600)}, kHeat);
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_NEAR(path->path.length, 600, 6);
  EXPECT_TRUE(path->warnings.empty());
}

TEST(Streamline, OfHeatNeedsTheHeatMethod) {
  const PathFinder finder = finder_on(finish(sphere(1)));
  const auto path = finder.find(std::vector{vertex(0), vertex(9)}, kHeat);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, ErrorCode::kBadInput);
}

TEST(Streamline, ThatIsStuckGoesOnAlongEdgesAndSaysSo) {
  const MeshPtr mesh = finish(sphere(2));
  const PathSurface surface(mesh);
  const std::vector<double> flat(mesh->positions().size(), 1.0);
  const auto line = trace_streamline(surface, {flat}, vertex(3), vertex(90));
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_TRUE(line->stuck);
  EXPECT_TRUE(is_path(*mesh, line->path));
  EXPECT_EQ(line->path.points.back().vertex, 90);
}

class StreamlineOn : public testing::TestWithParam<ZooMesh> {};

TEST_P(StreamlineOn, LeadsToTheGoalOrIsRefused) {
  const MeshPtr mesh = GetParam().mesh();
  const PathFinder finder = finder_on(mesh, MethodKind::kHeat);
  const Index last = mesh->vertex_count() - 1;
  const SurfacePoint inside = SurfacePoint::in_face(0, {0.2, 0.5, 0.3});
  for (const SurfacePoint& from : {vertex(0), inside}) {
    for (const PathOptions& options : {kDistance, kHeat}) {
      const auto path = finder.find(std::vector{from, vertex(last)}, options);
      if (path) {
        EXPECT_TRUE(is_path(*mesh, path->path));
        EXPECT_EQ(path->path.points.back().vertex, last);
      } else {
        EXPECT_EQ(path.error().code, ErrorCode::kBadInput) << path.error().message;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, StreamlineOn, testing::ValuesIn(zoo()), zoo_name);

}  // namespace
}  // namespace geotherm::test
