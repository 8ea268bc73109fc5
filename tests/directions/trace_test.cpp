// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "geotherm/directions.h"
#include "tests/support/broken_mesh.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr double kTraceExact = 1e-9;

std::shared_ptr<const Directions> directions_on(const MeshPtr& mesh) {
  auto built = Directions::build(mesh);
  EXPECT_TRUE(built) << built.error().message;
  return *built;
}

TracedLine traced(const Directions& directions, const SurfacePoint& from, double direction,
                  double length) {
  auto line = directions.trace(from, direction, length);
  EXPECT_TRUE(line) << line.error().message;
  return *std::move(line);
}

/// The pieces add up to the length, and each lies in its face.
void expect_sound(const TriangleMesh& mesh, const TracedLine& line, double size) {
  EXPECT_EQ(line.path.points.size(), line.path.faces.size() + 1);
  EXPECT_NEAR(length_of(mesh, line.path.points), line.path.length, kTraceExact * size);
}

class TracedOnThePlane : public testing::TestWithParam<SurfacePoint> {};

/// To its whole length where that is inside of the square, or else to the border.
TEST_P(TracedOnThePlane, LinesAreStraight) {
  const MeshPtr mesh = finish(jittered_plane(10, 0.3, 7));
  const auto directions = directions_on(mesh);
  const auto frame = directions->frame_at(GetParam());
  ASSERT_TRUE(frame);
  const Vec3 from = position_at(*mesh, GetParam());
  for (const double length : {0.0, 0.05, 0.3, 2.0}) {
    for (int i = 0; i < 40; ++i) {
      const double angle =
          frame->on_boundary ? frame->angle * (i + 0.5) / 40 : 0.1 + 2 * std::numbers::pi * i / 40;
      const Vec3 way = frame->vector(angle);
      double most = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 2; ++k) {
        if (way[k] > 0) most = std::min(most, (1 - from[k]) / way[k]);
        if (way[k] < 0) most = std::min(most, -from[k] / way[k]);
      }
      const TracedLine line = traced(*directions, GetParam(), angle, length);
      EXPECT_EQ(line.end, length <= most ? TraceEnd::kLength : TraceEnd::kBoundary);
      EXPECT_NEAR(line.path.length, std::min(length, most), kTraceExact);
      const Vec3 to = position_at(*mesh, line.path.points.back());
      EXPECT_NEAR((to - from - std::min(length, most) * way).norm(), 0, kTraceExact);
      expect_sound(*mesh, line, 1);
      if (std::isnan(line.direction)) continue;
      const auto last = directions->frame_at(line.path.points.back());
      ASSERT_TRUE(last);
      EXPECT_NEAR((last->vector(line.direction) - way).norm(), 0, kTraceExact);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Points, TracedOnThePlane,
                         testing::Values(SurfacePoint::at_vertex(grid_vertex(10, 4, 5)),
                                         SurfacePoint::at_vertex(grid_vertex(10, 0, 5)),
                                         SurfacePoint::at_vertex(0),
                                         SurfacePoint::in_face(55, {0.2, 0.3, 0.5}),
                                         SurfacePoint::in_face(55, {0, 0.3, 0.7}),
                                         SurfacePoint::in_face(56, {0.6, 0, 0.4}),
                                         SurfacePoint::in_face(57, {0.6, 0.4, 0})));

/// Along edges, diagonals, and through the vertices on them.
TEST(Traced, LinesPassVerticesOfAGridStraight) {
  const MeshPtr mesh = finish(plane_grid(8, 8, 1, 1));
  const auto directions = directions_on(mesh);
  const SurfacePoint middle = SurfacePoint::at_vertex(grid_vertex(8, 4, 4));
  const auto frame = directions->frame_at(middle);
  ASSERT_TRUE(frame);
  for (int i = 0; i < 8; ++i) {
    const TracedLine line = traced(*directions, middle, i * std::numbers::pi / 4, 0.4);
    const Vec3 to = position_at(*mesh, line.path.points.back());
    const Vec3 want = Vec3(0.5, 0.5, 0) + frame->vector(i * std::numbers::pi / 4, 0.4);
    EXPECT_NEAR((to - want).norm(), 0, kTraceExact) << i;
    expect_sound(*mesh, line, 1);
  }
}

TEST(Traced, LinesGoAlongABorderThatIsStraightAndEndAtItsCorners) {
  const MeshPtr mesh = finish(plane_grid(8, 8, 1, 1));
  const auto directions = directions_on(mesh);
  const SurfacePoint from = SurfacePoint::at_vertex(grid_vertex(8, 4, 0));  // half-way
  const auto frame = directions->frame_at(from);
  ASSERT_TRUE(frame && frame->on_boundary);
  for (const double direction : {0.0, frame->angle}) {
    const auto line = directions->trace(from, direction, 0.3);
    ASSERT_TRUE(line) << sentence(line.error());
    EXPECT_EQ(line->end, TraceEnd::kLength) << direction;
    const Vec3 way = position_at(*mesh, line->path.points.back()) - position_at(*mesh, from);
    EXPECT_NEAR(way.norm(), 0.3, 1e-12) << direction;
    const auto farther = directions->trace(from, direction, 3);
    ASSERT_TRUE(farther);
    EXPECT_EQ(farther->end, TraceEnd::kBoundary);
    EXPECT_NEAR(farther->path.length, 0.5, 1e-12) << "to the corner of the square";
  }
}

/// Angles at the border of a file of floats are half a turn but for their rounding.
TEST(Traced, LinesGoAlongABorderOfFloats) {
  Draft draft = plane_grid(8, 8, 1, 1);
  const Eigen::AngleAxisd turn(0.3, Vec3(1, 2, 3).normalized());
  for (Vec3& p : draft.positions) p = (turn * p).cast<float>().cast<double>();
  const MeshPtr mesh = finish(draft);
  const auto directions = directions_on(mesh);
  constexpr double kFloats = 1e-6;
  for (int i = 1; i < 8; ++i) {
    const SurfacePoint from = SurfacePoint::at_vertex(grid_vertex(8, i, 0));
    const auto frame = directions->frame_at(from);
    ASSERT_TRUE(frame && frame->on_boundary);
    const TracedLine one = traced(*directions, from, 0, 3);
    const TracedLine other = traced(*directions, from, frame->angle, 3);
    EXPECT_NEAR(one.path.length + other.path.length, 1, kFloats) << i;
  }
}

TEST(Traced, LineWindsRoundACylinder) {
  constexpr Index kAround = 24, kAlong = 40;
  const Draft draft = prism(kAround, kAlong, 2);
  const MeshPtr mesh = finish(draft);
  const auto directions = directions_on(mesh);
  const Index source = 5;  // on the lower end, from where directions are angles to the border
  const auto frame = directions->frame_at(SurfacePoint::at_vertex(source));
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->angle, std::numbers::pi, kTraceExact);
  const double steep = std::atan2(1.0, 3.0);  // a third of a turn's height for each turn
  const TracedLine line = traced(*directions, SurfacePoint::at_vertex(source), steep, 5);
  EXPECT_EQ(line.end, TraceEnd::kLength);
  const Vec3 to = position_at(*mesh, line.path.points.back());
  const auto low = std::ranges::min(draft.positions, {}, [](const Vec3& p) { return p.z(); });
  EXPECT_NEAR(to.z() - low.z(), 5 * std::sin(steep), kTraceExact);
  expect_sound(*mesh, line, 5);
}

TEST(Traced, LineRoundASphereComesBack) {
  const MeshPtr mesh = finish(sphere(5));
  const auto directions = directions_on(mesh);
  for (int i = 0; i < 6; ++i) {
    const TracedLine line =
        traced(*directions, SurfacePoint::at_vertex(100), 0.3 + i, 2 * std::numbers::pi);
    const Vec3 to = position_at(*mesh, line.path.points.back());
    EXPECT_LT((to - mesh->positions()[100]).norm(), 0.001 * 2 * std::numbers::pi) << i;
  }
}

/// A log map's directions and distances lead to the vertices, where no path bends.
TEST(Traced, LinesOfALogMapEndAtItsVertices) {
  Draft draft = sphere(3);
  for (Vec3& p : draft.positions) p = Vec3(p.x(), 0.7 * p.y(), 0.5 * p.z());
  const MeshPtr mesh = finish(draft);
  const auto directions = directions_on(mesh);
  for (const SurfacePoint& from :
       {SurfacePoint::at_vertex(30), SurfacePoint::in_face(99, {0.5, 0.2, 0.3}),
        SurfacePoint::in_face(99, {0.5, 0, 0.5})}) {
    const auto map = directions->log_map(from);
    ASSERT_TRUE(map);
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      const TracedLine line = traced(*directions, from, map->directions[v], map->distances[v]);
      const Vec3 to = position_at(*mesh, line.path.points.back());
      EXPECT_LT((to - mesh->positions()[v]).norm(), 1e-7) << v;
    }
  }
}

TEST(Traced, LineFollowsAMoebiusStripOverItsSeam) {
  const MeshPtr mesh = finish(moebius(40, 4));
  const auto directions = directions_on(mesh);
  const SurfacePoint from = SurfacePoint::in_face(3, {0.3, 0.3, 0.4});
  const auto map = directions->log_map(from);
  ASSERT_TRUE(map);
  int reached = 0;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const TracedLine line =
        traced(*directions, from, map->directions[v], map->distances[v] * (1 - kTraceExact));
    const Vec3 to = position_at(*mesh, line.path.points.back());
    reached += (to - mesh->positions()[v]).norm() < 1e-6 ? 1 : 0;
  }
  EXPECT_GT(reached, mesh->vertex_count() / 3);  // the others are behind vertices that bend paths
}

TEST(Traced, LineEndsWhereThreePagesMeet) {
  const MeshPtr mesh = finish(graded_book(6));
  const auto directions = directions_on(mesh);
  int split = 0;
  for (Index f = 0; f < mesh->face_count(); ++f) {
    for (int i = 0; i < 8; ++i) {
      const TracedLine line = traced(*directions, SurfacePoint::in_face(f, {0.3, 0.3, 0.4}),
                                     0.05 + i * std::numbers::pi / 4, 100);
      EXPECT_NE(line.end, TraceEnd::kLength);
      split += line.end == TraceEnd::kSplit ? 1 : 0;
    }
  }
  EXPECT_GT(split, mesh->face_count());
}

TEST(Traced, LineThatLeavesTheSurfaceAtTheBorderIsRefused) {
  const auto directions = directions_on(finish(plane_grid(4, 4, 1, 1)));
  const auto line = directions->trace(SurfacePoint::at_vertex(2), -1, 1);
  ASSERT_FALSE(line);
  EXPECT_NE(line.error().message.find("-1"), std::string::npos) << line.error().message;
  EXPECT_FALSE(directions->trace(SurfacePoint::at_vertex(2), 1, -1));
  EXPECT_FALSE(directions->trace(SurfacePoint::at_vertex(2), std::nan(""), 1));
  EXPECT_FALSE(directions->trace(SurfacePoint::at_vertex(99), 1, 1));
}

TEST(Traced, LineIsCancelledOnItsWay) {
  const auto directions = directions_on(finish(sphere(2)));
  const SurfacePoint from = SurfacePoint::at_vertex(2);
  double seen = -1;
  const auto stop = [&](std::string_view, double share) { return (seen = share, false); };
  EXPECT_TRUE(directions->trace(from, 0.3, 3, stop)) << "a short line asks nobody";
  const auto line = directions->trace(from, 0.3, 3000, stop);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().code, ErrorCode::kCancelled);
  EXPECT_GT(seen, 0);
  EXPECT_LT(seen, 1);
}

class TracedOnBroken : public testing::TestWithParam<unsigned> {};

TEST_P(TracedOnBroken, MeshesIsFiniteOrOneSentence) {
  std::mt19937 random(GetParam());
  for (unsigned seed = 60 * GetParam(); seed < 60 * GetParam() + 60; ++seed) {
    const BrokenMesh broken = broken_mesh(seed);
    const auto mesh = TriangleMesh::build(broken.draft.positions, broken.draft.faces);
    if (!mesh) continue;
    const auto shared = std::make_shared<const TriangleMesh>(*mesh);
    const auto directions = Directions::build(shared);
    if (!directions) continue;
    double size = 0;
    for (const Face& face : shared->faces()) {
      for (const Index v : face) {
        size = std::max(size, (shared->positions()[v] - shared->positions()[face[0]]).norm());
      }
    }
    for (int i = 0; i < 20; ++i) {
      const auto f = std::uniform_int_distribution<Index>(0, shared->face_count() - 1)(random);
      const double a = std::uniform_real_distribution<double>(0, 1)(random);
      const SurfacePoint from = i % 2 == 0 ? SurfacePoint::in_face(f, {a, 1 - a, 0})
                                           : SurfacePoint::at_vertex(shared->faces()[f][0]);
      const auto line = (*directions)->trace(from, i * 0.7, size * 3);
      if (!line) {
        EXPECT_EQ(line.error().message.find('\n'), std::string::npos) << broken.recipe;
        continue;
      }
      EXPECT_LE(line->path.length, size * 3 * (1 + kTraceExact)) << broken.recipe;
      for (const Vec3& p : positions_of(*shared, line->path)) {
        EXPECT_TRUE(p.allFinite()) << broken.recipe;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TracedOnBroken, testing::Range(0U, 5U));

}  // namespace
}  // namespace geotherm::test
