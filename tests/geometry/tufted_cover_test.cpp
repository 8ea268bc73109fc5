// SPDX-License-Identifier: MIT
#include "solver/geometry/tufted_cover.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"

namespace geotherm::test {
namespace {

// Sums of a few rounded cotangents a row.
constexpr double kTuftedRoundOff = 1e-11;
// Flips accept cotangent sums down to this (delaunay.cpp).
constexpr double kAcceptedWeight = 1e-6;

Intrinsic cover_of(const TriangleMesh& mesh, bool flip) {
  Intrinsic in = intrinsic_of(mesh, false);
  make_tufted_cover(in.mesh, mesh.positions(), in.clean,
                    std::vector<char>(in.clean.faces.size(), 1));
  if (flip) in.flips = *flip_to_delaunay(in.mesh);
  return in;
}

class TuftedCover : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
};

TEST_P(TuftedCover, HasATwinForEverySideWithTheSameEndsAndLength) {
  const IntrinsicMesh cover = cover_of(*mesh, false).mesh;
  for (Side side = 0; side < static_cast<Side>(cover.twin.size()); ++side) {
    const Side twin = cover.twin[side];
    ASSERT_NE(twin, kNoSide) << "side " << side;
    EXPECT_EQ(cover.twin[twin], side);
    const auto end = [&](Side s, int k) { return cover.faces[face_of(s)][(corner_of(s) + k) % 3]; };
    EXPECT_EQ(end(side, 0), end(twin, 1));
    EXPECT_EQ(end(side, 1), end(twin, 0));
    EXPECT_EQ(cover.lengths[face_of(side)][corner_of(side)],
              cover.lengths[face_of(twin)][corner_of(twin)]);
  }
}

TEST_P(TuftedCover, HasTwiceTheOperatorsOfTheMesh) {
  const auto once = operators_of(*mesh, intrinsic_of(*mesh, false));
  const auto twice = operators_of(*mesh, cover_of(*mesh, false));
  const FemOperator L(once, 0, 1), M(twice, 0, 1);
  ASSERT_EQ(L.assembled().row, M.assembled().row);
  const LowerMatrix& lower = L.assembled();
  for (Index j = 0; j < L.size(); ++j) {
    for (auto e = lower.start[j]; e < lower.start[j + 1]; ++e) {
      EXPECT_NEAR(M.assembled().value[e], 2 * lower.value[e],
                  kTuftedRoundOff * (1 + L.diagonal()[j]));
    }
  }
  for (Index i = 0; i < once->size(); ++i) {
    EXPECT_NEAR(twice->mass[i], 2 * once->mass[i], kTuftedRoundOff * once->mass[i]);
  }
}

TEST_P(TuftedCover, HasNoNegativeWeightAfterFlips) {
  const FemOperator L(operators_of(*mesh, cover_of(*mesh, true)), 0, 1);
  const LowerMatrix& lower = L.assembled();
  for (Index j = 0; j < L.size(); ++j) {
    for (auto e = lower.start[j] + 1; e < lower.start[j + 1]; ++e) {
      EXPECT_LE(lower.value[e], kAcceptedWeight) << "between " << j << " and " << lower.row[e];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, TuftedCover, testing::ValuesIn(zoo()), zoo_name);

class TuftedCoverOfClosed : public TuftedCover {};

TEST_P(TuftedCoverOfClosed, IsTheIntrinsicDelaunayLaplacianTwice) {
  const auto once = operators_of(*mesh, intrinsic_of(*mesh, true));
  const auto twice = operators_of(*mesh, cover_of(*mesh, true));
  for (Index i = 0; i < once->size(); ++i) {
    EXPECT_NEAR(twice->mass[i], 2 * once->mass[i], kTuftedRoundOff * once->mass[i]);
    EXPECT_NEAR(twice->stiffness_diagonal[i], 2 * once->stiffness_diagonal[i],
                kTuftedRoundOff * once->stiffness_diagonal[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Zoo, TuftedCoverOfClosed,
                         testing::ValuesIn(zoo(kClosed | kManifold | kRegular)), zoo_name);

TEST(FacesThatNeedACover, AreThoseOfTheirComponentOnly) {
  Draft draft = sphere(1);
  const auto sound = draft.faces.size();
  append(draft, transformed(moebius(12, 2), 1, Vec3(5, 0, 0), false));
  const MeshPtr mesh = finish(draft);
  const std::vector<char> needed = faces_that_need_cover(clean_faces(*mesh), mesh->vertex_count());
  for (std::size_t f = 0; f < needed.size(); ++f) EXPECT_EQ(needed[f] != 0, f >= sound);
}

// Four faces about one edge, listed out of order: the copies that look at each other are glued.
TEST(SidesRoundAnEdge, AreGluedInTheOrderOfTheirAngles) {
  Draft draft;
  draft.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  draft.faces = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}};
  const IntrinsicMesh cover = cover_of(*finish(draft), false).mesh;
  const auto across = [&](Index face) { return face_of(cover.twin[3 * face]); };
  EXPECT_EQ(across(0), cover.back[2]);
  EXPECT_EQ(across(2), cover.back[1]);
  EXPECT_EQ(across(1), cover.back[3]);
  EXPECT_EQ(across(3), cover.back[0]);
}

}  // namespace
}  // namespace geotherm::test
