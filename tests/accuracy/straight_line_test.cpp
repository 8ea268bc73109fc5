// SPDX-License-Identifier: MIT
#include "solver/accuracy/distance_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/dice.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

// Of coordinates of up to some hundred units, whose squares are added up.
constexpr double kRoundOff = 1e-12;

double length_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  constexpr int kSteps = 4000;  // as good as a closed form to 1e-7 of the segment
  double least = kUnreached;
  for (int k = 0; k <= kSteps; ++k) {
    least = std::min(least, (p - (a + (b - a) * k / kSteps)).norm());
  }
  return least;
}

class StraightLines : public testing::TestWithParam<int> {
 protected:
  MeshPtr mesh = finish(transformed(torus(40, 20, 0.4), 3, {100, -20, 7}, true));
  std::vector<Index> ids = [] {
    std::vector<Index> out;
    for (int k = 0; k < GetParam(); ++k) out.push_back((k * 131 + 5) % 800);
    return out;
  }();
};

TEST_P(StraightLines, AreThoseToTheNearestOfAllPoints) {
  const StraightLine straight(*mesh, SourceSet::of_vertices(ids), 0.25);
  Index hint = 0;
  for (const Vec3& p : mesh->positions()) {
    double least = kUnreached;
    for (const Index v : ids) least = std::min(least, (p - mesh->positions()[v]).norm() / 0.25);
    const Vec3 place = straight.place(p);
    EXPECT_NEAR(straight.length(place), least, kRoundOff);
    EXPECT_EQ(straight.length_beyond(place, least + kRoundOff, hint), 0);
    EXPECT_NEAR(straight.length_beyond(place, 0.999 * least - kRoundOff, hint), least, kRoundOff);
  }
}

TEST_P(StraightLines, AreLongerByTheOffsets) {
  SourceSet sources = SourceSet::of_vertices(ids);
  for (std::size_t k = 0; k < ids.size(); ++k)
    sources.offsets.push_back(0.3 * static_cast<double>(k % 7));
  const StraightLine straight(*mesh, sources, 1);
  for (const Vec3& p : mesh->positions()) {
    double least = kUnreached;
    for (std::size_t k = 0; k < ids.size(); ++k) {
      least = std::min(least, (p - mesh->positions()[ids[k]]).norm() + sources.offsets[k]);
    }
    EXPECT_NEAR(straight.length(straight.place(p)), least, kRoundOff);
  }
}

TEST_P(StraightLines, EndAnywhereOnCurvesAndInFaces) {
  constexpr double kSteps = 1e-6;
  SourceSet sources;
  std::vector<std::array<Vec3, 2>> pieces;
  for (int k = 0; k < GetParam(); ++k) {
    const Face& face = mesh->faces()[static_cast<std::size_t>(37 * k % 1600)];
    const Vec3 a = mesh->positions()[face[0]], b = mesh->positions()[face[1]];
    if (k % 2 == 0) {
      sources.edges.push_back({face[0], face[1]});
      pieces.push_back({a, b});
    } else {
      sources.points.push_back(SurfacePoint::in_face(37 * k % 1600, {0.2, 0.5, 0.3}));
      const Vec3 at = 0.2 * a + 0.5 * b + 0.3 * mesh->positions()[face[2]];
      pieces.push_back({at, at});
    }
  }
  const StraightLine straight(*mesh, sources, 1);
  for (Index v = 0; v < mesh->vertex_count(); v += 29) {
    const Vec3 p = mesh->positions()[v];
    double least = kUnreached;
    for (const auto& [a, b] : pieces) least = std::min(least, length_to_segment(p, a, b));
    EXPECT_NEAR(straight.length(straight.place(p)), least, kSteps);
  }
}

// One, few, and so many that a tree is made.
INSTANTIATE_TEST_SUITE_P(Sources, StraightLines, testing::Values(1, 5, 60));

TEST(StraightLine, HasItsDigitsWhateverTheUnit) {
  for (const double scale : {1e-200, 1e200}) {
    const MeshPtr mesh = finish(transformed(plane_grid(3, 4, 3, 4), scale, {0, 0, 0}, false));
    const StraightLine straight(*mesh, SourceSet::of_vertices({0}), scale);
    EXPECT_NEAR(straight.length(straight.place(mesh->positions()[19])), 5, kRoundOff);
  }
}

}  // namespace
}  // namespace geotherm::test
