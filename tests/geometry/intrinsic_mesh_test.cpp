// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"

namespace geotherm::test {
namespace {

// The documented amount by which mollification makes triangle inequalities strict, of the longest
// side of the face.
constexpr double kStrictBy = 1e-5;
// Adding one number to lengths of order 1 costs a rounding or two each.
constexpr double kIntrinsicRoundOff = 1e-14;

class IntrinsicMeshes : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
  Intrinsic in = intrinsic_of(*mesh, false);
};

TEST_P(IntrinsicMeshes, SatisfyTriangleInequalitiesStrictly) {
  for (const auto& l : in.mesh.lengths) {
    const double longest = std::max({l[0], l[1], l[2]});
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(l[next_corner(k)] + l[previous_corner(k)] - l[k],
                (kStrictBy - kIntrinsicRoundOff) * longest - kIntrinsicRoundOff);
    }
  }
}

TEST_P(IntrinsicMeshes, HaveTheLengthsOfTheMesh) {
  for (Index f = 0; f < in.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = mesh->positions()[in.mesh.faces[f][k]] -
                        mesh->positions()[in.mesh.faces[f][next_corner(k)]];
      const double length = side.norm() / in.mesh.unit, off = kIntrinsicRoundOff * (1 + length);
      EXPECT_GE(in.mesh.lengths[f][k], length - off);
      EXPECT_LE(in.mesh.lengths[f][k], length + in.mesh.mollified.most + off);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, IntrinsicMeshes, testing::ValuesIn(zoo()), zoo_name);

class RegularIntrinsicMeshes : public IntrinsicMeshes {};

TEST_P(RegularIntrinsicMeshes, AreNotMollified) { EXPECT_EQ(in.mesh.mollified.edges, 0); }

INSTANTIATE_TEST_SUITE_P(Zoo, RegularIntrinsicMeshes, testing::ValuesIn(zoo(kRegular)), zoo_name);

TEST(WellShapedFaces, KeepTheirLengthsAtAnySizeBesideLargeOnes) {
  Draft draft = sphere(1);
  append(draft, transformed(sphere(1), 1e-12, Vec3(5, 0, 0), false));
  append(draft, transformed(sphere(1), 1e-60, Vec3::Zero(), false));
  EXPECT_EQ(intrinsic_of(*finish(draft), false).mesh.mollified.edges, 0);
}

TEST(Layout, PlacesATriangleByItsLengths) {
  const FaceLayout p = lay_out({4, 3, 5});
  EXPECT_DOUBLE_EQ(p.base, 4);
  EXPECT_DOUBLE_EQ(p.height, 3);
  EXPECT_DOUBLE_EQ(p.x, 4);
}

TEST(Layout, KeepsTheHeightOfANeedle) {
  // Two long sides of 1 and a short one of s: the height over a long side is s sqrt(1 - s^2 / 4).
  constexpr double kShort = 1e-9;
  EXPECT_NEAR(lay_out({1, kShort, 1}).height, kShort, 1e-12 * kShort);
}

TEST(Layout, KnowsTheCotangentsOfAnEquilateralTriangle) {
  for (int side = 0; side < 3; ++side) {
    EXPECT_NEAR(opposite_cotangent({2, 2, 2}, side), 1 / std::numbers::sqrt3, kIntrinsicRoundOff);
  }
}

}  // namespace
}  // namespace geotherm::test
