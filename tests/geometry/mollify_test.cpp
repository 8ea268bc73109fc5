// SPDX-License-Identifier: MIT
#include "solver/geometry/intrinsic_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/operators.h"

namespace geotherm::test {
namespace {

// The documented amount by which triangle inequalities are strict, and a rounding.
constexpr double kStrictButForRounding = 1e-5 * (1 - 1e-9);
// What one face may take, relative to its longest side: what is missing, and a tenth more so that
// corrections end; twice that where two of its sides are short.
constexpr double kMaxPerFace = 2.5e-5;

void expect_strict(const IntrinsicMesh& mesh) {
  for (const auto& l : mesh.lengths) {
    const double longest = std::max({l[0], l[1], l[2]});
    EXPECT_GE(l[0] + l[1] + l[2] - 2 * longest, kStrictButForRounding * longest);
  }
}

TEST(DegenerateFace, LengthensNoEdgeOfAnotherComponent) {
  Draft draft = jittered_plane(6, 0.2, 3);
  const Draft sound = draft;
  append(draft, {{{5, 0, 0}, {6, 0, 0}, {5.5, 0, 0}, {5.5, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}});
  const IntrinsicMesh mesh = intrinsic_of(*finish(draft), false).mesh;
  EXPECT_EQ(mesh.mollified.components, 1);
  EXPECT_EQ(mesh.mollified.faces, 1);
  expect_strict(mesh);
  const IntrinsicMesh alone = intrinsic_of(*finish(sound), false).mesh;
  for (Index f = 0; f < alone.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(mesh.lengths[f][k] * mesh.unit, alone.lengths[f][k] * alone.unit, 1e-15);
    }
  }
}

// One flat face along the whole border of a plane: eighty edges long.
TEST(LongFlatFace, LeavesEdgesThatAreNotItsOwn) {
  constexpr Index kCells = 80;
  Draft draft = plane_grid(kCells, 4, kCells, 4);
  draft.faces.push_back({0, kCells, 1});
  const IntrinsicMesh mesh = intrinsic_of(*finish(draft), false).mesh;
  EXPECT_LE(mesh.mollified.edges, 3);
  EXPECT_LE(mesh.mollified.most * mesh.unit, kMaxPerFace * kCells);
  expect_strict(mesh);
}

TEST(TinyFacesBesideADegenerateOne, KeepTheirSizeAFewRingsAway) {
  // A plane whose cells are a millionth of the flat face at its border.
  constexpr Index kCells = 30;
  constexpr double kCell = 1e-6;
  Draft draft = plane_grid(kCells, kCells, kCells * kCell, kCells * kCell);
  const Index far = draft.add({1, 0, 0});
  draft.faces.push_back({0, far, 1});
  const IntrinsicMesh mesh = intrinsic_of(*finish(draft), false).mesh;
  expect_strict(mesh);
  for (Index f = 0; f + 1 < mesh.face_count(); ++f) {
    const Vec3 middle = (draft.positions[mesh.faces[f][0]] + draft.positions[mesh.faces[f][1]] +
                         draft.positions[mesh.faces[f][2]]) /
                        3;
    if (middle.norm() < kCells / 2 * kCell) continue;
    EXPECT_LT(mesh.lengths[f][0] * mesh.unit, 1.5 * kCell) << "face " << f;
  }
}

TEST(FacesThatAreOnePoint, BecomeProperOnes) {
  Draft draft = plane_grid(2, 2, 1, 1);
  const Index p = draft.add({5, 5, 5});
  for (int i = 0; i < 3; ++i) draft.add({5, 5, 5});
  draft.faces.insert(draft.faces.end(), {{p, p + 1, p + 2}, {p, p + 2, p + 3}});
  const IntrinsicMesh mesh = intrinsic_of(*finish(draft), false).mesh;
  EXPECT_EQ(mesh.mollified.faces, 2);
  EXPECT_LT(mesh.mollified.most, kMaxPerFace);
  expect_strict(mesh);
}

}  // namespace
}  // namespace geotherm::test
