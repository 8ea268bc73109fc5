// SPDX-License-Identifier: MIT
#include "solver/geometry/delaunay.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "geotherm/sources.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"

namespace geotherm::test {
namespace {

// A length found through several flips, each with an error of one rounding relative to its own
// edges, which are up to 1e4 times longer or shorter than their neighbours.
constexpr double kLengthRoundOff = 1e-9;
constexpr double kAreaRoundOff = 1e-9;
constexpr double kEnergyRoundOff = 1e-9;

double area(const IntrinsicMesh& mesh) {
  double sum = 0;
  for (const auto& lengths : mesh.lengths) {
    const FaceLayout p = lay_out(lengths);
    sum += p.base * p.height / 2;
  }
  return sum;
}

/// Vertices in use minus edges plus faces; an edge is a pair of twins or a side without one.
Index euler_characteristic(const IntrinsicMesh& mesh) {
  std::vector<Index> used;
  for (const Face& face : mesh.faces) used.insert(used.end(), face.begin(), face.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  Index twice = 0;
  for (const Side twin : mesh.twin) twice += twin == kNoSide ? 2 : 1;
  return static_cast<Index>(used.size()) - twice / 2 + mesh.face_count();
}

class DelaunayFlips : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
  Intrinsic before = intrinsic_of(*mesh, false);
  Intrinsic after = intrinsic_of(*mesh, true);
};

TEST_P(DelaunayFlips, LeaveNoNegativeWeight) { EXPECT_EQ(count_non_delaunay(after.mesh), 0); }

TEST_P(DelaunayFlips, AreMadeOnlyWhereNeeded) {
  EXPECT_EQ(after.flips.empty(), count_non_delaunay(before.mesh) == 0);
}

TEST_P(DelaunayFlips, KeepTheArea) {
  EXPECT_NEAR(area(after.mesh), area(before.mesh), kAreaRoundOff * area(before.mesh));
}

TEST_P(DelaunayFlips, KeepTheEulerCharacteristic) {
  EXPECT_EQ(euler_characteristic(after.mesh), euler_characteristic(before.mesh));
}

TEST_P(DelaunayFlips, KeepBothSidesOfAnEdgeTogether) {
  const IntrinsicMesh& m = after.mesh;
  for (Side side = 0; side < static_cast<Side>(m.twin.size()); ++side) {
    const Side twin = m.twin[side];
    if (twin == kNoSide) continue;
    ASSERT_EQ(m.twin[twin], side);
    const Face &f = m.faces[face_of(side)], &g = m.faces[face_of(twin)];
    EXPECT_EQ(f[corner_of(side)], g[next_corner(corner_of(twin))]);
    EXPECT_EQ(f[next_corner(corner_of(side))], g[corner_of(twin)]);
    EXPECT_EQ(m.lengths[face_of(side)][corner_of(side)], m.lengths[face_of(twin)][corner_of(twin)]);
  }
}

TEST_P(DelaunayFlips, KeepTriangleInequalitiesStrict) {
  for (const auto& [a, b, c] : after.mesh.lengths) {
    EXPECT_GT(a + b, c);
    EXPECT_GT(b + c, a);
    EXPECT_GT(c + a, b);
  }
}

// Rippa 1990: of all triangulations with the same vertices, the Delaunay one has the least energy.
TEST_P(DelaunayFlips, DoNotRaiseTheDirichletEnergy) {
  const FemOperator L0(operators_of(*mesh, before), 0, 1), L1(operators_of(*mesh, after), 0, 1);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(L0.size(), [&] { return normal(random); });
  const double energy0 = x.dot(dense(L0.assembled()) * x);
  const double energy1 = x.dot(dense(L1.assembled()) * x);
  EXPECT_LE(energy1, energy0 * (1 + kEnergyRoundOff));
}

INSTANTIATE_TEST_SUITE_P(Zoo, DelaunayFlips, testing::ValuesIn(zoo()), zoo_name);

/// In the plane an intrinsic triangulation is an ordinary one.
class DelaunayFlipsInThePlane : public DelaunayFlips {
 protected:
  Vec3 place(const std::vector<Face>& faces, const SurfacePoint& point) const {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      p += point.weights[k] * mesh->positions()[faces[point.face][k]];
    }
    return p;
  }
  void expect_carried_in_place(const std::array<double, 3>& weights) const {
    for (Index f = 0; f < before.mesh.face_count(); ++f) {
      const SurfacePoint point = SurfacePoint::in_face(f, weights);
      const FacePiece piece =
          carry_pieces(after.flips, after.mesh.face_count(), {{f, weights, weights}}).front();
      const SurfacePoint carried = SurfacePoint::in_face(piece.face, piece.from);
      EXPECT_LE((place(after.mesh.faces, carried) - place(before.mesh.faces, point)).norm(),
                kLengthRoundOff * size())
          << "face " << f;
    }
  }
  double size() const { return mesh->positions().back().norm(); }
};

TEST_P(DelaunayFlipsInThePlane, GiveEuclideanLengths) {
  for (Index f = 0; f < after.mesh.face_count(); ++f) {
    const Face& face = after.mesh.faces[f];
    for (int k = 0; k < 3; ++k) {
      const double length =
          (mesh->positions()[face[k]] - mesh->positions()[face[next_corner(k)]]).norm();
      EXPECT_NEAR(after.mesh.lengths[f][k] * after.mesh.unit, length, kLengthRoundOff * size());
    }
  }
}

TEST_P(DelaunayFlipsInThePlane, CarryInnerPointsToTheirPlace) {
  expect_carried_in_place({0.2, 0.5, 0.3});
}

TEST_P(DelaunayFlipsInThePlane, CarryPointsOnEdgesToTheirPlace) {
  expect_carried_in_place({0.4, 0.0, 0.6});
}

TEST_P(DelaunayFlipsInThePlane, CarryCornersToTheirPlace) { expect_carried_in_place({0, 1, 0}); }

INSTANTIATE_TEST_SUITE_P(Zoo, DelaunayFlipsInThePlane, testing::ValuesIn(zoo(kPlanar | kRegular)),
                         zoo_name);

}  // namespace
}  // namespace geotherm::test
