// SPDX-License-Identifier: MIT
// What strokes do to vertices.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "app/session/sculpture.h"

namespace geotherm::app {
namespace {

constexpr double kRounding = 1e-14;  ///< of positions about 1

using Mesh = std::shared_ptr<const TriangleMesh>;

Mesh made(std::vector<Vec3> positions, std::vector<Face> faces) {
  auto mesh = TriangleMesh::build(std::move(positions), std::move(faces));
  EXPECT_TRUE(mesh);
  return std::make_shared<const TriangleMesh>(*std::move(mesh));
}

/// A unit square of n x n cells at z = 0, its vertices row by row, the normal upwards.
Mesh square(int n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) positions.emplace_back(x / double(n), y / double(n), 0);
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const Index a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      faces.push_back({a, b, d});
      faces.push_back({a, d, c});
    }
  }
  return made(std::move(positions), std::move(faces));
}

/// The square and its copy `below`, joined along one side alone.
Mesh folded(int n, double below) {
  const Mesh top = square(n);
  std::vector<Vec3> positions(top->positions().begin(), top->positions().end());
  std::vector<Face> faces(top->faces().begin(), top->faces().end());
  const Index count = top->vertex_count();
  for (Index v = 0; v < count; ++v) positions.push_back(positions[v] - Vec3(0, 0, below));
  for (const Face& face : top->faces()) {
    faces.push_back({face[0] + count, face[2] + count, face[1] + count});
  }
  for (Index x = 0; x < n; ++x) {
    faces.push_back({x, x + count, x + 1});
    faces.push_back({x + 1, x + count, x + 1 + count});
  }
  return made(std::move(positions), std::move(faces));
}

/// The face of the square whose first corner is the vertex in column x, row y.
FacePoint corner(int n, int x, int y) { return {2 * (y * n + x), {1, 0, 0}}; }

Sculpture sculpture(std::vector<Stroke> strokes) {
  Sculpture all;
  for (Stroke& stroke : strokes) all.strokes.push_back(std::make_shared<const Stroke>(stroke));
  return all;
}

std::vector<Vec3> sculpted(const Mesh& mesh, const Sculpture& wanted) {
  Sculptor sculptor(mesh);
  EXPECT_TRUE(sculptor.follow(wanted));
  return sculptor.positions();
}

TEST(Sculptor, PullsAPatchOutAlongItsNormalAndNothingElse) {
  constexpr int kCells = 20;
  const Mesh mesh = square(kCells);
  constexpr double kRadius = 0.25, kStrength = 0.2;
  const auto moved = sculpted(
      mesh, sculpture({{SculptTool::kPull, kRadius, kStrength, {corner(kCells, 10, 10)}}}));
  const Vec3 middle(0.5, 0.5, 0);
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec3& before = mesh->positions()[v];
    const double share = (before - middle).norm() / kRadius;
    const double weight = share < 1 ? std::pow(1 - share * share, 2) : 0;
    EXPECT_NEAR(moved[v].z(), kStrength * kRadius * weight, kRounding) << v;
    EXPECT_EQ(moved[v].head<2>(), before.head<2>()) << v;
  }
}

TEST(Sculptor, PushesTheOtherWay) {
  const Mesh mesh = square(8);
  const FacePoint point = corner(8, 4, 4);
  const auto out = sculpted(mesh, sculpture({{SculptTool::kPull, 0.3, 0.5, {point}}}));
  const auto in = sculpted(mesh, sculpture({{SculptTool::kPush, 0.3, 0.5, {point}}}));
  for (std::size_t v = 0; v < out.size(); ++v) EXPECT_EQ(out[v].z(), -in[v].z());
  EXPECT_GT(out[4 * 9 + 4].z(), 0);
}

TEST(Sculptor, LeavesTheFarSideOfAThinSheetWhereItIs) {
  constexpr int kCells = 20;
  const Mesh mesh = folded(kCells, 0.01);
  const auto moved =
      sculpted(mesh, sculpture({{SculptTool::kPull, 0.2, 1, {corner(kCells, 10, 10)}}}));
  const Index count = mesh->vertex_count() / 2;
  for (Index v = count; v < mesh->vertex_count(); ++v) {
    EXPECT_EQ(moved[v], mesh->positions()[v]) << v;
  }
  EXPECT_GT(moved[10 * 21 + 10].z(), 0.1);
}

TEST(Sculptor, SmoothsASpike) {
  constexpr int kCells = 8;
  const Mesh mesh = square(kCells);
  const FacePoint middle = corner(kCells, 4, 4);
  const Stroke spike{SculptTool::kPull, 0.1, 1, {middle}};  // of one vertex
  const auto rough = sculpted(mesh, sculpture({spike}));
  const auto even =
      sculpted(mesh, sculpture({spike, {SculptTool::kSmooth, 0.4, 1, {middle, middle}}}));
  EXPECT_EQ(rough[4 * 9 + 4].z(), 0.1);
  EXPECT_LT(even[4 * 9 + 4].z(), 0.05);
  EXPECT_GT(even[4 * 9 + 5].z(), 0) << "the neighbours rise";
}

TEST(Sculptor, SmoothsABorderAlongItself) {
  constexpr int kCells = 8;
  const Mesh mesh = square(kCells);
  const FacePoint point = corner(kCells, 4, 0);
  const auto moved = sculpted(mesh, sculpture({{SculptTool::kSmooth, 0.4, 1, {point, point}}}));
  for (Index x = 0; x <= kCells; ++x) EXPECT_EQ(moved[x], mesh->positions()[x]) << x;
}

TEST(Sculptor, LeadsToTheSameBitsWhateverWasTakenBackInBetween) {
  constexpr int kCells = 16;
  const Mesh mesh = square(kCells);
  const Stroke a{SculptTool::kPull, 0.3, 0.3, {corner(kCells, 5, 5), corner(kCells, 6, 6)}};
  const Stroke b{SculptTool::kPush, 0.2, 0.5, {corner(kCells, 7, 5)}};
  const Stroke c{SculptTool::kSmooth, 0.4, 0.7, {corner(kCells, 6, 6), corner(kCells, 8, 8)}};
  Stroke a_begun = a;
  a_begun.points.pop_back();
  Sculptor sculptor(mesh);
  for (const Sculpture& wanted :
       {sculpture({a_begun}), sculpture({a}), sculpture({a, b}), sculpture({a, b, c}),
        sculpture({a, c}), sculpture({a_begun, c}), sculpture({c}), sculpture({}),
        sculpture({b, a}), sculpture({a_begun}), sculpture({a, b, c})}) {
    ASSERT_TRUE(sculptor.follow(wanted));
    EXPECT_EQ(sculptor.positions(), sculpted(mesh, wanted)) << wanted.strokes.size();
  }
  ASSERT_TRUE(sculptor.follow({}));
  EXPECT_TRUE(std::ranges::equal(sculptor.positions(), mesh->positions()));
}

TEST(Sculptor, RefusesAFaceThatIsNotThere) {
  const Mesh mesh = square(2);
  Sculptor sculptor(mesh);
  const auto done = sculptor.follow(
      sculpture({{SculptTool::kPull, 0.3, 0.3, {corner(2, 0, 0), FacePoint{8, {1, 0, 0}}}}}));
  ASSERT_FALSE(done);
  EXPECT_EQ(sentence(done.error()),
            "there is no face 8 to sculpt; faces with three corners are among 0 to 7");
  ASSERT_TRUE(sculptor.follow({}));
  EXPECT_TRUE(std::ranges::equal(sculptor.positions(), mesh->positions()));
}

TEST(Sculptor, TakesWeldedVerticesAlong) {
  const Mesh plain = made({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.001, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                          {{0, 1, 2}, {3, 4, 5}});
  const auto welded = weld(*plain, 0.01);
  ASSERT_TRUE(welded);
  ASSERT_EQ(welded->merged, 2);
  const auto moved = sculpted(std::make_shared<const TriangleMesh>(welded->mesh),
                              sculpture({{SculptTool::kPull, 0.5, 1, {FacePoint{0, {0, 1, 0}}}}}));
  EXPECT_GT(moved[1].z(), 0.1);
  EXPECT_EQ(moved[3], moved[1]);
  EXPECT_EQ(moved[5], plain->positions()[5]);
}

}  // namespace
}  // namespace geotherm::app
