// SPDX-License-Identifier: MIT
// Distances over points by the heat method, against lengths that are known.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tests/points/point_samples.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

/// Mean error over the largest distance. The heat method is of first order in the spacing and about
/// 1 % wrong on meshes as coarse as these points; noise makes all ways longer: of 0.2 spacings by
/// some 4 % on a single edge, of which a path over many edges keeps less than half.
constexpr double kClean = 0.02, kNoisy = 0.04;

/// Points with a source and the distances that are right.
struct DistanceCase {
  SamplePoints points;
  double spacing;
  Index source;
  std::vector<double> right;
};

DistanceCase sphere_case() {
  constexpr Index kPoints = 3000;
  DistanceCase out{sphere_points(kPoints), std::sqrt(4 * std::numbers::pi / kPoints), 1000, {}};
  const Vec3 from = out.points.positions[static_cast<std::size_t>(out.source)];
  for (const Vec3& p : out.points.positions) {
    out.right.push_back(std::atan2(p.cross(from).norm(), p.dot(from)));
  }
  return out;
}

DistanceCase plane_case() {
  constexpr Index kSide = 50;
  DistanceCase out{plane_points(kSide, 0.4, 7), 1, 20 * kSide + 15, {}};
  const Vec3 from = out.points.positions[static_cast<std::size_t>(out.source)];
  for (const Vec3& p : out.points.positions) out.right.push_back((p - from).norm());
  return out;
}

double mean_error(const DistanceCase& sample, LaplacianKind laplacian, bool with_normals) {
  const auto& points = sample.points;
  const PointSurface surface =
      surface_from(cloud_of(points.positions, with_normals ? points.normals : std::vector<Vec3>{}));
  EXPECT_EQ(surface.outliers, 0);
  HeatOptions options;
  options.laplacian = laplacian;
  const auto result =
      solve(std::make_shared<const TriangleMesh>(surface.mesh), {sample.source}, options);
  double sum = 0;
  for (std::size_t i = 0; i < sample.right.size(); ++i) {
    sum += std::abs(result.distances[i] - sample.right[i]);
  }
  return sum / static_cast<double>(sample.right.size()) / std::ranges::max(sample.right);
}

struct DistanceKind {
  std::string name;
  LaplacianKind laplacian;
  bool with_normals;
};

class PointDistances : public testing::TestWithParam<DistanceKind> {
 protected:
  static void expect_near(DistanceCase sample) {
    const auto [name, laplacian, with_normals] = GetParam();
    EXPECT_LT(mean_error(sample, laplacian, with_normals), kClean);
    add_noise(sample.points, 0.2 * sample.spacing, 11);
    EXPECT_LT(mean_error(sample, laplacian, with_normals), kNoisy);
  }
};

TEST_P(PointDistances, OnASphereAreThoseOfGreatCircles) { expect_near(sphere_case()); }

TEST_P(PointDistances, OnAPlaneAreStraight) { expect_near(plane_case()); }

INSTANTIATE_TEST_SUITE_P(Kinds, PointDistances,
                         testing::Values(DistanceKind{"tufted", LaplacianKind::kTufted, false},
                                         DistanceKind{"auto", LaplacianKind::kAuto, false},
                                         DistanceKind{"normals", LaplacianKind::kAuto, true}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace geotherm::test
