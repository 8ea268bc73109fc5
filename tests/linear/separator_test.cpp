// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/separator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "solver/linear/symmetric_pattern.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

GraphPart part_of(const TriangleMesh& mesh) {
  const SymmetricPattern pattern = pattern_of_faces(mesh.vertex_count(), mesh.faces());
  GraphPart out;
  out.start.assign(pattern.start.begin(), pattern.start.end());
  out.neighbor = pattern.neighbor;
  out.vertex.resize(static_cast<std::size_t>(pattern.size()));
  std::iota(out.vertex.begin(), out.vertex.end(), 0);
  for (const Vec3& p : mesh.positions()) {
    out.position.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  return out;
}

/// That it separates, and counts right.
void expect_separates(const GraphPart& part, const Separator& separator) {
  ASSERT_EQ(separator.half.size(), part.vertex.size());
  std::array<Index, 3> count{};
  for (Index i = 0; i < part.size(); ++i) {
    ++count[separator.half[i]];
    for (Index k = part.start[i]; k < part.start[i + 1]; ++k) {
      const bool crosses =  // the other way round, too: neighbours stand in both lists
          separator.half[i] == kLeft && separator.half[part.neighbor[k]] == kRight;
      ASSERT_FALSE(crosses) << i << " beside " << part.neighbor[k];
    }
  }
  EXPECT_EQ(separator.count, count);
}

class SeparatorOf : public testing::TestWithParam<ZooMesh> {
 protected:
  GraphPart part = part_of(*GetParam().mesh());
};

TEST_P(SeparatorOf, APartKeepsItsHalvesApart) { expect_separates(part, find_separator(part)); }

TEST_P(SeparatorOf, EveryPlaneKeepsTheHalvesApartAndAQuarterOnEachSide) {
  for (const Separator& cut : plane_cuts(part, 9, 1)) {
    expect_separates(part, cut);
    const Index separator = cut.count[kSeparator];
    EXPECT_GE(std::min(cut.count[kLeft], cut.count[kRight]) + separator,
              static_cast<Index>(kSmallestShare * part.size()));
  }
}

TEST_P(SeparatorOf, APlaneNeverGrowsByRefinement) {
  for (Separator cut : plane_cuts(part, 9, 1)) {
    const Index before = cut.count[kSeparator];
    refine_separator(part, cut);
    expect_separates(part, cut);
    EXPECT_LE(cut.count[kSeparator], before);
  }
}

TEST_P(SeparatorOf, APartIsNoLargerThanTheBestPlanesRefined) {
  double least = HUGE_VAL;
  for (Separator cut : plane_cuts(part, 1, 1)) {
    refine_separator(part, cut);
    if (cut.count[kLeft] == 0 || cut.count[kRight] == 0) continue;
    least = cut.count[kSeparator] *
            imbalance(cut.count[kLeft] + cut.count[kSeparator] / 2, part.size());
  }
  const Separator found = find_separator(part);
  const double cost = found.count[kSeparator] *
                      imbalance(found.count[kLeft] + found.count[kSeparator] / 2, part.size());
  EXPECT_LE(cost, least * 1.01 + 1);  // what is not needed goes to the smaller half
}

INSTANTIATE_TEST_SUITE_P(Zoo, SeparatorOf, testing::ValuesIn(zoo()), zoo_name);

/// About an oblique axis.
void turn(GraphPart& part) {
  const Eigen::Matrix3f turned =
      Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  for (auto& p : part.position) {
    const Eigen::Vector3f q = turned * Eigen::Vector3f(p[0], p[1], p[2]);
    p = {q[0], q[1], q[2]};
  }
}

TEST(Separator, OfATurnedTorusIsTwoRings) {
  GraphPart part = part_of(*finish(torus(200, 20, 0.1)));
  turn(part);
  EXPECT_EQ(find_separator(part).count[kSeparator], 2 * 20);
}

TEST(Separator, FindsADiagonalCut) {
  // A band along the diagonal between x and y, whose cells are twice as wide across: a plane across
  // an axis crosses two lines of vertices.
  GraphPart part = part_of(*finish(plane_grid(120, 10, 1, 1)));
  for (auto& p : part.position) p = {12 * p[0] - 2 * p[1], 12 * p[0] + 2 * p[1], 0};
  const std::vector<Separator> cuts = plane_cuts(part, 9, 1);
  ASSERT_GE(cuts.size(), 2U);
  EXPECT_EQ(cuts[0].count[kSeparator], 11);
  EXPECT_GE(cuts[1].count[kSeparator], 16);
}

TEST(Separator, ShrinksAroundADetour) {
  // A straight cut of a grid with a detour around a square of 8 x 8 beside it.
  constexpr Index kSide = 40, kCut = 20;
  const GraphPart part = part_of(*finish(plane_grid(kSide, kSide, 1, 1)));
  Separator detour;
  detour.half.resize(part.vertex.size());
  for (Index i = 0; i < part.size(); ++i) {
    const Index x = i % (kSide + 1), y = i / (kSide + 1);
    const bool beside = y >= 10 && y < 18;
    const Index line = beside ? kCut + 8 : kCut;
    const bool rim = x >= kCut && x <= kCut + 8 && (y == 9 || y == 18);
    const Half half = x == line || rim ? kSeparator : x < line ? kLeft : kRight;
    detour.half[i] = half;
    ++detour.count[half];
  }
  expect_separates(part, detour);
  ASSERT_EQ(detour.count[kSeparator], kSide + 1 + 16);
  refine_separator(part, detour);
  expect_separates(part, detour);
  EXPECT_LE(detour.count[kSeparator], kSide + 1 + 12);  // one pass: corners are cut, 10 are left
}

TEST(Separator, LeavesOneFarPointAlone) {
  // All others are in a place as small as floats can tell apart at the scale of that one.
  GraphPart part = part_of(*finish(torus(60, 40, 0.4)));
  for (auto& p : part.position) p = {p[0] * 1e-40F, p[1] * 1e-40F, p[2] * 1e-40F};
  expect_separates(part, find_separator(part));
  part.position[7] = {1, 1, 1};
  expect_separates(part, find_separator(part));
}

}  // namespace
}  // namespace geotherm::test
