// SPDX-License-Identifier: MIT
#include "solver/volume/tet_slice.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/models/volumes.h"
#include "tests/support/dice.h"

namespace geotherm::test {
namespace {

constexpr double kRounding = 1e-12;
/// What counts as on the plane.
constexpr double kNear = 1e-9;

/// A sliced volume, measured.
class Sliced {
 public:
  Sliced(const TetMesh& mesh, const SlicePlane& plane, double near = kNear)
      : mesh_(mesh),
        surface(slice(mesh.positions(), boundary(mesh)->faces, mesh.tets(), plane, near)) {}

  Vec3 place(Index corner) const {
    const auto positions = mesh_.positions();
    const auto v = static_cast<std::size_t>(corner);
    if (v < positions.size()) return positions[v];
    const EdgePoint& p = surface.points[v - positions.size()];
    return positions[p.a] + p.share * (positions[p.b] - positions[p.a]);
  }
  Vec3 area_vector(std::size_t f) const {
    const Face& face = surface.faces[f];
    return 0.5 * (place(face[1]) - place(face[0])).cross(place(face[2]) - place(face[0]));
  }
  bool in_cut(std::size_t f) const { return surface.origin[f] == kNoIndex; }

  double cut_area(const Vec3& normal) const {
    double sum = 0;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      if (in_cut(f)) sum += area_vector(f).dot(normal);
    }
    return sum;
  }
  /// 0 where the surface is closed.
  Vec3 area_vectors() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t f = 0; f < surface.faces.size(); ++f) sum += area_vector(f);
    return sum;
  }
  /// By the divergence theorem.
  double volume() const {
    double sum = 0;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      sum += area_vector(f).dot(place(surface.faces[f][0])) / 3;
    }
    return sum;
  }

 private:
  const TetMesh& mesh_;

 public:
  SlicedSurface surface;
};

const Vec3 kBoxSides(2, 1.5, 1);

class BoxSlices : public testing::TestWithParam<double> {};

TEST_P(BoxSlices, HaveTheAreaOfTheCrossSectionAndCloseWhatIsLeft) {
  const TetMesh box = make_box_tets(8, 6, 4, kBoxSides);
  const double at = GetParam();
  const Sliced sliced(box, {Vec3::UnitX(), at * kBoxSides.x()});
  EXPECT_NEAR(sliced.cut_area(Vec3::UnitX()), at > 0 ? 1.5 * 1 : 0, kRounding);
  EXPECT_NEAR(sliced.area_vectors().norm(), 0, kRounding);
  EXPECT_NEAR(sliced.volume(), at * 3, 3 * kNear);
}

// 0.25, 0.5 and the ends lie on vertices, 0.5 + 1e-12 within rounding of them.
INSTANTIATE_TEST_SUITE_P(Places, BoxSlices,
                         testing::Values(0, 0.1, 0.25, 0.3, 0.5, 0.5 + 1e-12, 0.77, 1));

TEST(TetSlices, OfACubeAcrossItsDiagonalAreARegularHexagon) {
  const TetMesh cube = make_box_tets(5, 5, 5, Vec3::Ones());
  const Vec3 normal = Vec3::Ones().normalized();
  const Sliced sliced(cube, {normal, 1.5 / std::sqrt(3.0)});
  EXPECT_NEAR(sliced.cut_area(normal), 3 * std::sqrt(3.0) / 4, kRounding);
  EXPECT_NEAR(sliced.volume(), 0.5, kRounding);
}

TEST(TetSlices, OfABallTendToTheDiscWithTheSquareOfTheEdgesSlow) {
  for (const double height : {0.0, 0.35, -0.6}) {
    const Vec3 normal = Vec3(1, 2, -0.5).normalized();
    const double disc = std::numbers::pi * (1 - height * height);
    const auto missing = [&](Index layers) {
      return disc - Sliced(make_ball_tets(layers), {normal, height}).cut_area(normal);
    };
    const double coarse = missing(6), fine = missing(12);
    EXPECT_GT(coarse, 0) << height;  // its corners lie on the sphere
    EXPECT_LT(coarse, 0.03 * disc) << height;
    EXPECT_NEAR(coarse / fine, 4, 0.5) << height;
  }
}

TEST(TetSlices, HaveEveryPointOnThePlaneAndNoneOfTheirFacesSharesACornerWithTheBorderSlow) {
  const TetMesh ball = make_ball_tets(8);
  Dice dice(3);
  for (int i = 0; i < 20; ++i) {
    const Vec3 normal = dice.in_cube().normalized();
    const double offset = 0.8 * dice.in_cube().x();
    const Sliced sliced(ball, {normal, offset});
    EXPECT_NEAR(sliced.area_vectors().norm(), 0, kRounding);
    std::vector<Index> in_border, in_cut;
    for (std::size_t f = 0; f < sliced.surface.faces.size(); ++f) {
      const Face& face = sliced.surface.faces[f];
      auto& corners = sliced.in_cut(f) ? in_cut : in_border;
      corners.insert(corners.end(), face.begin(), face.end());
      for (const Index corner : face) {
        const double height = normal.dot(sliced.place(corner)) - offset;
        EXPECT_LE(height, kRounding);
        EXPECT_GE(height, sliced.in_cut(f) ? -kRounding : -2.0);
      }
    }
    const std::size_t first = sliced.surface.faces.size() - sliced.surface.tets.size();
    for (std::size_t c = 0; c < sliced.surface.tets.size(); ++c) {
      ASSERT_TRUE(sliced.in_cut(first + c));
      const Tet& tet = ball.tets()[static_cast<std::size_t>(sliced.surface.tets[c])];
      for (const Index corner : sliced.surface.faces[first + c]) {
        const EdgePoint& p =
            sliced.surface.points[static_cast<std::size_t>(corner - ball.vertex_count())];
        EXPECT_TRUE(std::ranges::count(tet, p.a) == 1 && std::ranges::count(tet, p.b) == 1);
      }
    }
    std::ranges::sort(in_border);
    std::ranges::sort(in_cut);
    std::vector<Index> both;
    std::ranges::set_intersection(in_border, in_cut, std::back_inserter(both));
    EXPECT_TRUE(both.empty());
  }
}

TEST(TetSlices, CutFacesAloneWhereThereAreNoTets) {
  const TetMesh box = make_box_tets(4, 3, 2, kBoxSides);
  const auto border = boundary(box);
  const SlicedSurface left = slice(box.positions(), border->faces, {}, {Vec3::UnitY(), 0.6}, 1e-9);
  ASSERT_FALSE(left.faces.empty());
  EXPECT_TRUE(std::ranges::all_of(left.origin, [](Index f) { return f != kNoIndex; }));
  EXPECT_TRUE(std::ranges::is_sorted(left.origin));
}

TEST(TetPeels, AreTheBorderOfTheTetsThatStay) {
  const TetMesh ball = make_ball_tets(6);
  const auto border = boundary(ball);
  std::vector<char> keep;
  double volume = 0;
  for (const Tet& tet : ball.tets()) {
    const auto at = [&](std::size_t k) -> const Vec3& { return ball.positions()[tet[k]]; };
    keep.push_back((at(0) + at(1) + at(2) + at(3)).x() > 0.4 ? 1 : 0);
    if (keep.back() == 0) continue;
    volume += (at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0))) / 6;
  }
  const PeeledSurface peeled = peel(ball, border->faces, keep);
  double enclosed = 0;
  std::size_t of_border = 0;
  for (std::size_t f = 0; f < peeled.faces.size(); ++f) {
    const Face& face = peeled.faces[f];
    const auto at = [&](std::size_t k) -> const Vec3& { return ball.positions()[face[k]]; };
    enclosed += at(0).dot(at(1).cross(at(2))) / 6;
    if (peeled.origin[f] == kNoIndex) continue;
    ++of_border;
    const auto whole = static_cast<std::size_t>(peeled.origin[f]);
    EXPECT_EQ(peeled.tets[f], border->tets[whole]);
    Face same = border->faces[whole], sorted = face;
    std::ranges::sort(same);
    std::ranges::sort(sorted);
    EXPECT_EQ(same, sorted);
  }
  EXPECT_NEAR(enclosed, volume, kRounding);
  std::size_t expected = 0;
  for (const Index t : border->tets) expected += keep[static_cast<std::size_t>(t)] != 0;
  EXPECT_EQ(of_border, expected);
  EXPECT_TRUE(peel(ball, border->faces, std::vector<char>(keep.size(), 0)).faces.empty());
}

}  // namespace
}  // namespace geotherm::test
