// SPDX-License-Identifier: MIT
// Faces of many corners: which triangles they become.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/mesh/io/raw_mesh.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using Points = std::vector<Vec3>;

std::vector<Face> fan_of(std::size_t corners) {
  std::vector<Face> fan;
  for (std::size_t i = 2; i < corners; ++i) {
    fan.push_back({0, static_cast<Index>(i - 1), static_cast<Index>(i)});
  }
  return fan;
}

Vec3 cross(const Points& p, const Face& f) { return (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[0]]); }

/// The definition: the first ear in the order of corners, again and again; the fan where there is
/// none or where it does not fold.
std::vector<Face> brute_force(const Points& points) {
  const std::vector<Face> fan = fan_of(points.size());
  Vec3 normal = Vec3::Zero();
  for (const Face& f : fan) normal += cross(points, f);
  bool folded = false;
  for (const Face& f : fan) folded |= !(cross(points, f).dot(normal) > 0);
  if (!folded || !(normal.norm() > 0)) return fan;
  normal.normalize();
  const auto turn = [&](Index a, Index b, Index c) { return cross(points, {a, b, c}).dot(normal); };
  std::vector<Index> left;
  for (std::size_t i = 0; i < points.size(); ++i) left.push_back(static_cast<Index>(i));
  const auto is_ear = [&](const Face& t) {
    if (!(turn(t[0], t[1], t[2]) > 0)) return false;
    for (const Index v : left) {
      if (points[v] == points[t[0]] || points[v] == points[t[1]] || points[v] == points[t[2]]) {
        continue;
      }
      const bool inside =
          turn(t[0], t[1], v) >= 0 && turn(t[1], t[2], v) >= 0 && turn(t[2], t[0], v) >= 0;
      if (inside) return false;
    }
    return true;
  };
  std::vector<Face> ears;
  while (ears.size() < fan.size()) {
    bool cut = false;
    for (std::size_t i = 0; i < left.size() && !cut; ++i) {
      const std::size_t n = left.size();
      const Face t = {left[(i + n - 1) % n], left[i], left[(i + 1) % n]};
      if (n > 3 && !is_ear(t)) continue;
      ears.push_back(t);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
    }
    if (!cut) return fan;
  }
  return ears;
}

std::vector<Face> triangles_of(const Points& points) {
  std::vector<Face> faces = fan_of(points.size());
  io::PolygonCutter cutter(faces.size());
  EXPECT_TRUE(cutter.triangulate(points, faces));
  return faces;
}

/// Corners around the origin at random distances, in a random plane, a little beside it.
Points ragged_outline(std::mt19937_64& random, int corners, double beside) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(6 * unit(random), Vec3(1, unit(random), 2).normalized()));
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = 0.1 + unit(random);
    const Vec3 flat(radius * std::cos(angle), radius * std::sin(angle), beside * unit(random));
    points.emplace_back(turn * flat);
  }
  return points;
}

/// A band that winds six times around the origin, there and back: few of its corners see others.
Points spiral(int corners) {
  Points points;
  const auto add = [&](int i, double start) {
    const double part = 2.0 * i / corners, angle = 12 * std::numbers::pi * part;
    const double radius = start + 0.9 * part;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  };
  for (int i = 0; i < corners / 2; ++i) add(i, 0.1);
  for (int i = corners / 2; i-- > 0;) add(i, 0.06);
  return points;
}

TEST(Polygons, BecomeTheTrianglesOfTheDefinition) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 300; ++i) {
    const Points points = ragged_outline(random, 4 + i % 60, i % 3 == 0 ? 0.2 : 0);
    EXPECT_EQ(triangles_of(points), brute_force(points)) << i;
  }
  EXPECT_EQ(triangles_of(spiral(300)), brute_force(spiral(300)));
}

TEST(Polygons, ThatCrossThemselvesBecomeThoseOfTheDefinitionAsWell) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    Points points;
    for (int k = 0; k < 4 + i % 20; ++k) points.emplace_back(unit(random), unit(random), 0);
    EXPECT_EQ(triangles_of(points), brute_force(points)) << i;
  }
}

/// Teeth of height 100 on a bar, each as wide as the gap beside it.
Points comb(int teeth) {
  Points points = {{0, 0, 0}, {2.0 * teeth - 1, 0, 0}};
  for (int i = teeth; i-- > 0;) {
    points.emplace_back(2 * i + 1, 110, 0);
    points.emplace_back(2 * i, 110, 0);
    if (i == 0) break;
    points.emplace_back(2 * i, 10, 0);
    points.emplace_back(2 * i - 1, 10, 0);
  }
  return points;
}

void expect_covered_once(const Points& points) {
  double outline = 0, covered = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& a = points[i];
    const Vec3& b = points[(i + 1) % points.size()];
    outline += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  for (const Face& f : triangles_of(points)) covered += cross(points, f).norm() / 2;
  constexpr double kRounding = 1e-12;  // of some thousand areas
  EXPECT_NEAR(covered, std::abs(outline), kRounding * covered);
}

TEST(Polygons, OfThousandsOfCornersAreCoveredOnce) {
  expect_covered_once(spiral(4000));
  expect_covered_once(comb(1250));
}

TEST(Polygons, ThatAreTooMuchWorkAreRefused) {
  // Long needles that cross each other everywhere: every triangle's box holds all of the corners.
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int kCorners = 60'000;
  std::string text = "OFF\n" + std::to_string(kCorners) + " 1 0\n";
  for (int i = 0; i < kCorners; ++i) {
    text +=
        std::to_string(i % 2 + 1e-3 * unit(random)) + ' ' + std::to_string(unit(random)) + " 0\n";
  }
  text += std::to_string(kCorners);
  for (int i = 0; i < kCorners; ++i) text += ' ' + std::to_string(i);
  const auto file = read_bytes("needles.off", text + '\n');
  ASSERT_FALSE(file);
  EXPECT_NE(sentence(file.error()).find("a polygon with 60000 corners"), std::string::npos)
      << file.error().message;
  EXPECT_EQ(sentence(file.error()).find('\n'), std::string::npos);
}

class PolygonFiles : public testing::TestWithParam<Sample> {};

TEST_P(PolygonFiles, KeepTheirFaces) {
  const TemporaryDirectory folder;
  const auto file = read_polygons(folder.write(GetParam().file, GetParam().bytes));
  ASSERT_TRUE(file) << sentence(file.error());
  const PolygonMesh& mesh = file->mesh;
  if (GetParam().file.ends_with(".stl")) {  // triangles alone
    EXPECT_EQ(mesh.start.size(), 7U);
    return;
  }
  EXPECT_EQ(mesh.positions, pyramid_positions());
  ASSERT_EQ(mesh.start.size(), 6U);
  std::vector<std::int64_t> corners;
  for (std::size_t f = 1; f < 6; ++f) corners.push_back(mesh.start[f] - mesh.start[f - 1]);
  EXPECT_EQ(std::ranges::count(corners, 3), 4);
  EXPECT_EQ(std::ranges::count(corners, 4), 1);
  const auto triangles = triangulated(mesh);
  ASSERT_TRUE(triangles);
  EXPECT_TRUE(std::ranges::equal(triangles->faces(), pyramid_faces()));
}

INSTANTIATE_TEST_SUITE_P(Formats, PolygonFiles, testing::ValuesIn(pyramid_samples()),
                         [](const auto& sample) { return sample.param.name; });

TEST(PolygonFile, ThatCannotBeReadAreOneLine) {
  const TemporaryDirectory folder;
  EXPECT_EQ(read_polygons(folder.path("none.obj")).error().code, ErrorCode::kBadFile);
  EXPECT_EQ(read_polygons(folder.write("a.foo", "x")).error().code, ErrorCode::kNotAvailable);
  EXPECT_EQ(read_polygons(folder.write("a.obj", "v 0 0 0\n")).error().code, ErrorCode::kBadFile);
  const PolygonMesh bad{{Vec3::Zero()}, {0, 3}, {0, 1, 2}};
  EXPECT_NE(triangulated(bad).error().message.find("face 0 has the corner 1"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
