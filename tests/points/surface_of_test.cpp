// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <string>

#include "geotherm/build_method.h"
#include "tests/points/point_samples.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

/// Faces with corners both below and from `first_upper` on.
Index faces_between(const TriangleMesh& mesh, Index first_upper) {
  return static_cast<Index>(std::ranges::count_if(mesh.faces(), [&](const Face& face) {
    const auto upper = std::ranges::count_if(face, [&](Index v) { return v >= first_upper; });
    return upper == 1 || upper == 2;
  }));
}

/// Two planes above each other that face away from each other.
SamplePoints two_sheets_of_points(double gap) {
  SamplePoints out = plane_points(20, 0.3, 1);
  const SamplePoints upper = plane_points(20, 0.3, 2);
  for (Vec3& normal : out.normals) normal = -normal;
  for (const Vec3& p : upper.positions) out.positions.push_back(p + gap * Vec3::UnitZ());
  out.normals.insert(out.normals.end(), upper.normals.begin(), upper.normals.end());
  return out;
}

TEST(PointClouds, RefuseWhatIsNone) {
  EXPECT_EQ(PointCloud::build({}).error().message, "the point cloud has no points");
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(PointCloud::build({{0, 0, 0}, {0, inf, 0}}).error().message,
            "a coordinate of point 1 is not finite");
  EXPECT_EQ(PointCloud::build({{0, 0, 0}, {0, 1, 0}}, {{0, 0, 1}}).error().message,
            "there are 1 normal for 2 points; each needs one, or none has");
}

TEST(PointSurfaces, RefusePointsThatMakeNone) {
  for (const Index count : {1, 2, 3, 50}) {
    std::vector<Vec3> line;
    for (Index i = 0; i < count; ++i) line.push_back(i * Vec3(1, 2, 3));
    const auto surface = surface_of(cloud_of(line));
    ASSERT_FALSE(surface) << count;
    EXPECT_EQ(surface.error().code, ErrorCode::kBadInput);
    EXPECT_NE(surface.error().message.find("make no surface"), std::string::npos);
  }
  // Three are too few wherever they lie, and four are enough; the hint says so.
  std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto three = surface_of(cloud_of(corners));
  ASSERT_FALSE(three);
  EXPECT_NE(sentence(three.error()).find("at least four points"), std::string::npos);
  corners.emplace_back(1, 1, 0);
  EXPECT_TRUE(surface_of(cloud_of(corners)));
  const auto same = surface_of(cloud_of(std::vector<Vec3>(100, Vec3(1, 2, 3))));
  ASSERT_FALSE(same);
  EXPECT_TRUE(same.error().message.starts_with("100 points at 1 place "));
  for (const int neighbours : {5, 101}) {
    const auto surface = surface_of(cloud_of(sphere_points(50).positions), {neighbours});
    ASSERT_FALSE(surface);
    EXPECT_NE(surface.error().message.find(std::to_string(neighbours)), std::string::npos);
  }
}

TEST(PointSurfaces, OfAnEvenSphereAreClosed) {
  const PointSurface surface = surface_from(cloud_of(sphere_points(1000).positions));
  EXPECT_EQ(surface.mesh.face_count(), 2 * 1000 - 4);  // Euler
  EXPECT_EQ(surface.parts, 1);
  EXPECT_EQ(surface.outliers, 0);
  EXPECT_EQ(surface.duplicates, 0);
  EXPECT_TRUE(surface.warnings.empty());
  // So far apart are points of a lattice of equilateral triangles of the same density; the
  // Fibonacci lattice is less even.
  const double lattice = std::sqrt(2 / std::sqrt(3.0) * 4 * std::numbers::pi / 1000);
  EXPECT_GT(surface.spacing, 0.8 * lattice);
  EXPECT_LT(surface.spacing, lattice);
}

TEST(PointSurfaces, OfAGridHaveTwoFacesASquare) {
  const PointSurface surface = surface_from(cloud_of(plane_points(30, 0, 1).positions));
  std::set<std::set<Index>> faces;
  for (const Face& face : surface.mesh.faces()) faces.insert({face[0], face[1], face[2]});
  EXPECT_EQ(faces.size(), surface.mesh.faces().size());
  // Squares' corners lie on circles: where two of them see different planes by rounding, both
  // diagonals are there.
  constexpr double kBothDiagonals = 1.3;
  EXPECT_GE(surface.mesh.face_count(), 2 * 29 * 29);
  EXPECT_LE(surface.mesh.face_count(), kBothDiagonals * 2 * 29 * 29);
}

TEST(PointSurfaces, GiveEveryDuplicateItsDistance) {
  std::vector<Vec3> points = sphere_points(500).positions;
  points.insert(points.end(), points.begin(), points.begin() + 200);
  points.insert(points.end(), 60, points[7]);  // more than there are neighbours
  const PointSurface surface = surface_from(cloud_of(points));
  EXPECT_EQ(surface.duplicates, 260);
  ASSERT_EQ(surface.notes.size(), 2U);
  EXPECT_TRUE(surface.notes[1].starts_with("260 of 760 points")) << surface.notes[1];
  const auto method = build_method(std::make_shared<const TriangleMesh>(surface.mesh));
  ASSERT_TRUE(method) << sentence(method.error());
  const auto result = (*method)->solve(SourceSet::of_vertices({507}));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->distances[7], 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(std::isfinite(result->distances[i])) << i;
    if (i >= 500 && i < 700) {
      EXPECT_EQ(result->distances[i], result->distances[i - 500]);
    }
  }
}

TEST(PointSurfaces, LeaveOutliersUnreached) {
  std::vector<Vec3> points = sphere_points(1000).positions;
  points.insert(points.begin() + 500, {{0, 0, 1.5}, {3, 0, 0}, {0, 0, 0}});
  const PointSurface surface = surface_from(cloud_of(points));
  EXPECT_EQ(surface.outliers, 3);
  EXPECT_EQ(surface.mesh.face_count(), 2 * 1000 - 4);
  ASSERT_EQ(surface.warnings.size(), 1U);
  EXPECT_TRUE(surface.warnings[0].message.starts_with("3 of 1003 points lie off the surface"));
  const auto result = solve(std::make_shared<const TriangleMesh>(surface.mesh), {0});
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(std::isfinite(result.distances[i]), i < 500 || i > 502) << i;
  }
}

TEST(PointSurfaces, JoinSheetsNearerThanTheirPointsAndSaySo) {
  const SamplePoints sheets = two_sheets_of_points(0.5);
  const PointSurface joined = surface_from(cloud_of(sheets.positions));
  EXPECT_GT(faces_between(joined.mesh, 400), 400);
  EXPECT_GT(joined.between_sheets, 400);
  ASSERT_EQ(joined.warnings.size(), 1U);
  EXPECT_NE(joined.warnings[0].message.find("two sheets"), std::string::npos);

  const PointSurface apart = surface_from(cloud_of(sheets.positions, sheets.normals));
  EXPECT_EQ(faces_between(apart.mesh, 400), 0);
  EXPECT_EQ(apart.parts, 2);
  EXPECT_TRUE(apart.warnings.empty());
}

TEST(PointSurfaces, JoinNoSheetsThatAreFarApart) {
  const PointSurface far = surface_from(cloud_of(two_sheets_of_points(4).positions));
  EXPECT_EQ(faces_between(far.mesh, 400), 0);
  EXPECT_TRUE(far.warnings.empty());
}

TEST(PointSurfaces, SayThatNormalsPointToBothSides) {
  SamplePoints plane = plane_points(30, 0.3, 1);
  for (std::size_t i = 0; i < plane.normals.size(); i += 2) plane.normals[i] *= -3;
  const PointSurface torn = surface_from(cloud_of(plane.positions, plane.normals));
  ASSERT_FALSE(torn.warnings.empty());
  EXPECT_NE(torn.warnings.back().message.find("both sides"), std::string::npos);
  PointOptions options;
  options.normals_separate = false;
  EXPECT_TRUE(surface_from(cloud_of(plane.positions, plane.normals), options).warnings.empty());
}

TEST(PointSurfaces, DependNeitherOnUnitsNorOnWhereTheyLie) {
  const std::vector<Vec3> points = sphere_points(300).positions;
  for (const double scale : {1e-150, 1e-9, 1e9, 1e150}) {
    std::vector<Vec3> moved;
    for (const Vec3& p : points) moved.emplace_back(scale * (p + Vec3(1e4, 0, -1e4)));
    const PointSurface surface = surface_from(cloud_of(moved));
    EXPECT_EQ(surface.mesh.face_count(), 2 * 300 - 4) << scale;
    EXPECT_NEAR(surface.spacing / scale, surface_from(cloud_of(points)).spacing, 1e-9) << scale;
  }
}

TEST(PointSurfaces, HaveTheSameBitsWithAnyNumberOfThreads) {
  SamplePoints points = sphere_points(33000);  // enough for two threads
  add_noise(points, 0.002, 3);
  const PointCloud cloud = cloud_of(points.positions);
  const auto one = surface_of(cloud, {}, {}, 1), four = surface_of(cloud, {}, {}, 4);
  ASSERT_TRUE(one && four);
  EXPECT_TRUE(std::ranges::equal(one->mesh.faces(), four->mesh.faces()));
  EXPECT_EQ(one->spacing, four->spacing);
  EXPECT_EQ(one->notes, four->notes);
}

TEST(PointSurfaces, StopWhenTheirProgressSaysSo) {
  const PointCloud cloud = cloud_of(sphere_points(5000).positions);
  for (int most : {1, 2, 4}) {
    const auto surface = surface_of(cloud, {}, [&](std::string_view stage, double) {
      EXPECT_EQ(stage, "surface");
      return --most > 0;
    });
    ASSERT_FALSE(surface);
    EXPECT_EQ(surface.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(most, 0);
  }
  struct Thrown {};
  const auto throws = [](std::string_view, double share) -> bool {
    if (share > 0) throw Thrown{};
    return true;
  };
  EXPECT_THROW((void)surface_of(cloud, {}, throws), Thrown);
}

}  // namespace
}  // namespace geotherm::test
