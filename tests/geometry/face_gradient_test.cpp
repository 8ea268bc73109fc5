// SPDX-License-Identifier: MIT
#include "solver/geometry/face_gradient.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// A few roundings, enlarged by the shape of the triangles (angles of 5 degrees and more).
constexpr double kGradientRoundOff = 1e-12;
// A needle of height 1e-6 has lost as many digits.
constexpr double kNeedleRoundOff = 1e-9;

/// Values of the function with this gradient.
std::vector<double> linear_values(const TriangleMesh& mesh, const Vec3& gradient) {
  std::vector<double> values;
  for (const Vec3& p : mesh.positions()) values.push_back(gradient.dot(p) + 0.25);
  return values;
}

TEST(FaceGradient, OfALinearFunctionInThePlaneIsExact) {
  const MeshPtr mesh = finish(jittered_plane(12, 0.3, 7));
  const Vec3 expected(0.7, -1.3, 0);
  for (const Vec3& gradient : face_gradients(*mesh, linear_values(*mesh, expected))) {
    ASSERT_LE((gradient - expected).norm(), kGradientRoundOff);
  }
}

TEST(FaceGradient, OfALinearFunctionInSpaceIsItsPartInEachFace) {
  const MeshPtr mesh = finish(torus(24, 12, 0.4));
  const Vec3 whole(0.7, -1.3, 2.1);
  const std::vector<Vec3> gradients = face_gradients(*mesh, linear_values(*mesh, whole));
  for (Index f = 0; f < mesh->face_count(); ++f) {
    const auto& [a, b, c] = mesh->faces()[f];
    const auto p = mesh->positions();
    const Vec3 normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
    ASSERT_LE((gradients[f] - (whole - whole.dot(normal) * normal)).norm(), kGradientRoundOff);
  }
}

class FaceGradientScale : public testing::TestWithParam<double> {};

TEST_P(FaceGradientScale, ChangesNoDigitThatMatters) {
  const double scale = GetParam();
  const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(scale, 0, 0), Vec3(0, 2 * scale, 0)};
  const Vec3 of_lengths = triangle_gradient(corners, {0, scale, 0});
  EXPECT_LE((of_lengths - Vec3(1, 0, 0)).norm(), kGradientRoundOff);
  const Vec3 of_values =
      triangle_gradient({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0)}, {0, scale, -scale});
  EXPECT_LE((of_values / scale - Vec3(1, -0.5, 0)).norm(), kGradientRoundOff);
}

INSTANTIATE_TEST_SUITE_P(Of, FaceGradientScale, testing::Values(1e-300, 1e-150, 1.0, 1e150, 1e300),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

TEST(FaceGradient, OfANeedleIsRightWhicheverCornerComesFirst) {
  const std::array<Vec3, 3> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1e-6, 0)};
  const Vec3 expected(3, -4, 0);
  for (std::size_t first = 0; first < 3; ++first) {
    std::array<Vec3, 3> turned;
    std::array<double, 3> values;
    for (std::size_t i = 0; i < 3; ++i) {
      turned[i] = corners[(first + i) % 3];
      values[i] = expected.dot(turned[i]);
    }
    EXPECT_LE((triangle_gradient(turned, values) - expected).norm(), kNeedleRoundOff) << first;
  }
}

TEST(FaceGradient, IsZeroWhereThereIsNone) {
  const Vec3 o(1, 2, 3);
  const Vec3 x(2, 2, 3);
  const Vec3 y(1, 3, 3);
  EXPECT_EQ(triangle_gradient({o, o, o}, {0, 1, 2}), Vec3::Zero());
  EXPECT_EQ(triangle_gradient({o, x, o}, {0, 1, 2}), Vec3::Zero());
  EXPECT_EQ(triangle_gradient({o, x, Vec3(3, 2, 3)}, {0, 1, 2}), Vec3::Zero());
  EXPECT_EQ(triangle_gradient({o, x, y}, {5, 5, 5}), Vec3::Zero());
  EXPECT_EQ(triangle_gradient({o, x, y}, {0, kUnreached, 1}), Vec3::Zero());
  EXPECT_EQ(triangle_gradient({o, x, y}, {kUnreached, kUnreached, kUnreached}), Vec3::Zero());
  EXPECT_EQ(triangle_gradient({o, x, y}, {0, std::nan(""), 1}), Vec3::Zero());
}

}  // namespace
}  // namespace geotherm::test
