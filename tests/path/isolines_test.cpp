// SPDX-License-Identifier: MIT
#include "geotherm/path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/path/path_support.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

std::vector<double> heights(const TriangleMesh& mesh) {
  std::vector<double> out;
  for (const Vec3& p : mesh.positions()) out.push_back(p.z());
  return out;
}

std::vector<Isoline> isolines(const TriangleMesh& mesh, std::span<const double> values,
                              std::span<const double> levels) {
  auto found = find_isolines(mesh, values, levels);
  EXPECT_TRUE(found) << (found ? "" : sentence(found.error()));
  return found ? *std::move(found) : std::vector<Isoline>();
}

TEST(Isolines, OfAPlanesCoordinateGoStraightFromBorderToBorder) {
  const MeshPtr mesh = finish(jittered_plane(10, 0.3, 2));
  std::vector<double> x;
  for (const Vec3& p : mesh->positions()) x.push_back(p.x());
  const double levels[] = {0.15, 0.5, 0.77};
  const auto lines = isolines(*mesh, x, levels);
  ASSERT_EQ(lines.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lines[i].value, levels[i]);
    EXPECT_FALSE(lines[i].path.closed);
    EXPECT_NEAR(lines[i].path.length, 1, 1e-12);
    EXPECT_TRUE(is_path(*mesh, lines[i].path));
  }
}

TEST(Isolines, AreCancelledByTheirProgressBetweenLevels) {
  const MeshPtr mesh = finish(sphere(3));
  const double levels[] = {-0.5, 0, 0.5};
  for (const int most : {0, 2, 3}) {
    int asked = 0;
    const auto stop = [&](std::string_view, double) { return asked++ < most; };
    const auto lines = find_isolines(*mesh, heights(*mesh), levels, stop);
    ASSERT_FALSE(lines) << most;
    EXPECT_EQ(lines.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(asked, most + 1);
  }
}

TEST(Isolines, OfASpheresHeightAreClosedCirclesOfTheirLength) {
  const MeshPtr mesh = finish(sphere(4));
  const double levels[] = {-0.6, 0.1, 0.8};
  const auto lines = isolines(*mesh, heights(*mesh), levels);
  ASSERT_EQ(lines.size(), 3U);
  for (const Isoline& line : lines) {
    EXPECT_TRUE(line.path.closed);
    const double circle = 2 * std::numbers::pi * std::sqrt(1 - line.value * line.value);
    EXPECT_NEAR(line.path.length, circle, 0.01 * circle);  // chords of edges of 0.07
    EXPECT_TRUE(is_path(*mesh, line.path));
    EXPECT_LT(
        (positions_of(*mesh, line.path).front() - positions_of(*mesh, line.path).back()).norm(),
        1e-12);
  }
}

/// Coarea formula: the integral of |grad h| is that of the lengths of the level sets of h.
TEST(Isolines, LengthsAddUpToTheIntegralOfTheSlope) {
  const MeshPtr mesh = finish(torus(24, 16, 0.4));
  constexpr int kLevels = 2000;
  std::vector<double> levels;
  for (int i = 0; i < kLevels; ++i) levels.push_back(-0.4 + 0.8 * (i + 0.5) / kLevels);
  double sum = 0, expected = 0;
  for (const Isoline& line : isolines(*mesh, heights(*mesh), levels)) {
    sum += line.path.length * 0.8 / kLevels;
  }
  for (const auto& [a, b, c] : mesh->faces()) {
    const Vec3 normal = (mesh->positions()[b] - mesh->positions()[a])
                            .cross(mesh->positions()[c] - mesh->positions()[a]);
    expected += normal.head<2>().norm() / 2;
  }
  EXPECT_NEAR(sum, expected, 1e-3 * expected);
}

TEST(Isolines, ThroughVerticesHaveNoPieceWithoutLength) {
  const MeshPtr mesh = finish(plane_grid(8, 8, 8, 8));
  std::vector<double> sum;
  for (const Vec3& p : mesh->positions()) sum.push_back(p.x() + p.y());
  const double levels[] = {1, 3, 8, 11};
  const auto lines = isolines(*mesh, sum, levels);
  ASSERT_EQ(lines.size(), 4U);
  for (const Isoline& line : lines) {
    const auto places = positions_of(*mesh, line.path);
    for (std::size_t i = 1; i < places.size(); ++i)
      EXPECT_GT((places[i] - places[i - 1]).norm(), 0);
    EXPECT_TRUE(is_path(*mesh, line.path));
    const double diagonal = std::min(line.value, 16 - line.value) * std::numbers::sqrt2;
    EXPECT_NEAR(line.path.length, diagonal, 1e-12);
  }
}

TEST(Isolines, AtAPeakAreNone) {
  const MeshPtr mesh = finish(plane_grid(2, 2, 2, 2));
  std::vector<double> peak(9, 0.0);
  peak[4] = 1;
  const double levels[] = {1.0};
  EXPECT_TRUE(isolines(*mesh, peak, levels).empty());
}

TEST(Isolines, LeaveOutFacesWithoutAFiniteValue) {
  const MeshPtr mesh = finish(plane_grid(4, 1, 4, 1));
  std::vector<double> y;
  for (const Vec3& p : mesh->positions()) y.push_back(p.y());
  y[grid_vertex(4, 2, 0)] = std::numeric_limits<double>::infinity();
  y[grid_vertex(4, 0, 1)] = std::numeric_limits<double>::quiet_NaN();
  const double levels[] = {0.5};
  double length = 0;
  for (const Isoline& line : isolines(*mesh, y, levels)) {
    EXPECT_TRUE(is_path(*mesh, line.path));
    length += line.path.length;
  }
  EXPECT_GT(length, 0);
  EXPECT_LT(length, 4);
}

class IsolinesOn : public testing::TestWithParam<ZooMesh> {};

TEST_P(IsolinesOn, ArePathsAtTheirLevelAndClosedWhereThereIsNoBorder) {
  const MeshPtr mesh = GetParam().mesh();
  std::vector<double> values;
  for (const Vec3& p : mesh->positions()) values.push_back(p.x() + 0.3 * p.y() + 0.7 * p.z());
  const auto [low, high] = std::ranges::minmax(values);
  std::vector<double> levels;
  for (int i = 0; i <= 10; ++i) levels.push_back(low + (high - low) * i / 10);
  for (const Isoline& line : isolines(*mesh, values, levels)) {
    EXPECT_TRUE(is_path(*mesh, line.path));
    EXPECT_GE(line.path.points.size(), 2U);
    if ((GetParam().tags & kClosed) != 0 && (GetParam().tags & kManifold) != 0) {
      EXPECT_TRUE(line.path.closed);
    }
    for (const Vec3& p : positions_of(*mesh, line.path)) {
      EXPECT_NEAR(p.x() + 0.3 * p.y() + 0.7 * p.z(), line.value, 1e-9 * (high - low));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, IsolinesOn, testing::ValuesIn(zoo()), zoo_name);

}  // namespace
}  // namespace geotherm::test
