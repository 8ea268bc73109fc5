// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bench/models/volumes.h"
#include "solver/volume/tet_marching_method.h"
#include "solver/volume/tet_update.h"
#include "tests/support/dice.h"

namespace geotherm::test {
namespace {

std::shared_ptr<const DistanceMethod> marching_on(TetMesh mesh,
                                                  double straight_reach = kUnreached) {
  return *build_tet_marching(std::make_shared<const TetMesh>(std::move(mesh)), 1, {},
                             straight_reach);
}

DistanceResult marched(const DistanceMethod& method, const SourceSet& sources) {
  QueryOptions query;
  query.nearest = true;
  return *method.solve(sources, query);
}

SourceSet in_tet(Index tet, std::vector<double> weights) {
  SourceSet set;
  set.cell_points = {{tet, std::move(weights)}};
  return set;
}

/// Mean of the error over the mean distance, both from vertex 0 in a convex volume.
double error_from_first(const TetMesh& mesh, double straight_reach) {
  const DistanceResult d = marched(*marching_on(mesh, straight_reach), SourceSet::of_vertices({0}));
  double error = 0, all = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double line = (mesh.positions()[v] - mesh.positions()[0]).norm();
    EXPECT_GE(d.distances[v], line * (1 - 1e-12));
    error += std::abs(d.distances[v] - line);
    all += line;
  }
  return error / all;
}

TEST(TetUpdate, IsExactForPlaneFrontsThroughTheFace) {
  Dice dice(11);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<KnownCorner, 3> known;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = known[k].offset = dice.in_cube();
    const Vec3 direction = -dice.in_cube().normalized();
    for (KnownCorner& each : known) each.value = 5 + each.offset.dot(direction);
    const bool through = cross_face(corners, -100 * direction).crosses;
    const double u = updated_distance(known);
    if (through) {
      EXPECT_NEAR(u, 5, 1e-9);
    }
    EXPECT_GE(u, 5 - 1e-9);  // never in front of the plane
    inside += through;
  }
  EXPECT_GT(inside, 100);
}

/// The least over a fine grid of points of the face.
double least_by_trial(const std::array<KnownCorner, 3>& known) {
  constexpr int kParts = 200;
  double least = kUnreached;
  for (int i = 0; i <= kParts; ++i) {
    for (int j = 0; i + j <= kParts; ++j) {
      const double a = double(i) / kParts, b = double(j) / kParts, c = 1 - a - b;
      const Vec3 x = a * known[0].offset + b * known[1].offset + c * known[2].offset;
      least =
          std::min(least, a * known[0].value + b * known[1].value + c * known[2].value + x.norm());
    }
  }
  return least;
}

TEST(TetUpdate, IsTheLeastOverTheFaceForAnyValues) {
  Dice dice(12);
  for (int i = 0; i < 60; ++i) {
    std::array<KnownCorner, 3> known;
    for (KnownCorner& each : known) each = {dice.in_cube(), dice.between(0, 1.5)};
    const double least = least_by_trial(known), u = updated_distance(known);
    EXPECT_LE(u, least + 1e-12);
    EXPECT_GE(u, least - 1e-3);
  }
  // What is not known is left out.
  std::array<KnownCorner, 3> one = {
      {{{1, 0, 0}, kUnreached}, {{0, 2, 0}, 1}, {{0, 0, 1}, kUnreached}}};
  EXPECT_EQ(updated_distance(one), 3);
  one[1].value = kUnreached;
  EXPECT_EQ(updated_distance(one), kUnreached);
}

TEST(TetMarching, IsExactWhereEveryVertexSeesItsSource) {
  EXPECT_LT(error_from_first(make_ball_tets(6), kUnreached), 1e-13);
  EXPECT_LT(error_from_first(make_box_tets(8, 6, 4, Vec3(2, 1.5, 1)), kUnreached), 1e-13);
}

TEST(TetMarching, ErrorOfPlanesFallsWithTheEdgeLengthSlow) {
  double before_ball = 1, before_box = 1;
  for (const Index n : {5, 10, 20}) {
    const double ball = error_from_first(make_ball_tets(n), 0.25);
    const double box = error_from_first(make_box_tets(n, n, n, Vec3(1, 1, 1)), 0.25);
    EXPECT_LT(ball, 0.75 * before_ball);
    EXPECT_LT(box, 0.75 * before_box);
    before_ball = ball;
    before_box = box;
  }
  EXPECT_LT(before_ball, 0.02);
  EXPECT_LT(before_box, 0.02);
}

/// A slab of cubes without those that `hole` holds, by their middle.
template <class Hole>
TetMesh slab(Index n, const Hole& hole) {
  const TetMesh box = make_box_tets(2 * n, 2 * n, 2, Vec3(2, 2, 2.0 / n));
  std::vector<Tet> tets;
  for (const Tet& t : box.tets()) {
    Vec3 middle = Vec3::Zero();
    for (const Index v : t) middle += box.positions()[v] / 4;
    if (!hole(middle)) tets.push_back(t);
  }
  return *TetMesh::build({box.positions().begin(), box.positions().end()}, tets);
}

TEST(TetMarching, BendsRoundACorner) {
  for (const Index n : {4, 8, 16}) {
    const TetMesh mesh =
        slab(n, [](const Vec3& p) { return p.x() > 1 && p.y() < 1; });  // an L in the plane
    const Index source = closest_point(mesh, {0, 0, 0})->point.vertex;
    const DistanceResult d = marched(*marching_on(mesh), SourceSet::of_vertices({source}));
    double error = 0;
    int reached = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3& p = mesh.positions()[v];
      if (p.x() > 1 && p.y() < 1) continue;
      // Straight, or over the edge x = y = 1: both parts unfold into one plane.
      const double bent = std::sqrt(2.0) + std::hypot(p.x() - 1, p.y() - 1);
      const double way = p.y() >= p.x() || p.x() <= 1 ? std::hypot(p.x(), p.y()) : bent;
      error += std::abs(d.distances[v] - std::hypot(way, p.z()));
      ++reached;
    }
    error /= reached;
    EXPECT_LT(error, 1e-13) << n;  // 0.01 without the edge as a source of its own
  }
}

/// From (0, 1) round the square pillar in the middle of a slab, in the plane.
double round_the_pillar(const Vec3& p) {
  const double x = p.x(), y = 1 + std::abs(p.y() - 1);
  const double to_pillar = std::hypot(0.75, 0.25);
  if (x <= 0.75 || y - 1 >= x / 3) return std::hypot(x, y - 1);
  if (y >= 1.25) return to_pillar + std::hypot(x - 0.75, y - 1.25);
  return to_pillar + 0.5 + std::hypot(x - 1.25, y - 1.25);
}

TEST(TetMarching, RoundStraightEdgesDistancesAreThoseOfUnfoldedWays) {
  for (const Index n : {4, 8}) {
    const TetMesh mesh = slab(
        n, [](const Vec3& p) { return std::abs(p.x() - 1) < 0.25 && std::abs(p.y() - 1) < 0.25; });
    const Index source = closest_point(mesh, {0, 1, 0})->point.vertex;
    const DistanceResult d = marched(*marching_on(mesh), SourceSet::of_vertices({source}));
    double error = 0, all = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3& p = mesh.positions()[v];
      if (d.distances[v] == kUnreached) continue;  // in no tet
      const double way = std::hypot(round_the_pillar(p), p.z());
      EXPECT_GE(d.distances[v], way * (1 - 1e-12)) << p.transpose();
      if (p.x() >= 1.25 && std::abs(p.y() - 1) <= 0.25) {
        EXPECT_NEAR(d.distances[v], way, 1e-12) << "behind two edges, " << p.transpose();
      }
      error += d.distances[v] - way;
      all += way;
    }
    EXPECT_LT(error, 0.003 * all) << n;
  }
}

/// The mesh with a wall without thickness at x = 1, from y = 0.5 to y = 1.
TetMesh with_slit(const TetMesh& mesh) {
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Tet> tets(mesh.tets().begin(), mesh.tets().end());
  std::map<Index, Index> behind;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = positions[v];
    if (std::abs(p.x() - 1) > 1e-9 || p.y() < 0.5 + 1e-9 || p.y() > 1 - 1e-9) continue;
    behind[v] = static_cast<Index>(positions.size());
    positions.push_back(p);
  }
  for (Tet& tet : tets) {
    double x = 0;
    for (const Index v : tet) x += positions[v].x() / 4;
    for (Index& v : tet) {
      if (const auto at = behind.find(v); x > 1 && at != behind.end()) v = at->second;
    }
  }
  return *TetMesh::build(std::move(positions), std::move(tets));
}

TEST(TetMarching, SeesNothingThroughAWallBesideReentrantEdges) {
  const auto notch = [](const Vec3& p) { return p.x() > 0.7 && p.x() < 0.8 && p.y() < 0.4; };
  const TetMesh mesh = with_slit(slab(10, notch));
  int behind = 0;
  for (const Vec3& from : {Vec3(0.2, 0.5, 0), Vec3(0.5, 0.3, 0), Vec3(0.4, 1.2, 0)}) {
    const Index source = closest_point(mesh, from)->point.vertex;
    const DistanceResult d = marched(*marching_on(mesh), SourceSet::of_vertices({source}));
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3& p = mesh.positions()[v];
      const double crossing = from.y() + (1 - from.x()) / (p.x() - from.x()) * (p.y() - from.y());
      if (p.x() <= 1 + 1e-9 || crossing <= 0.5 || crossing >= 1) continue;
      const auto over = [&](double y) {
        return std::hypot(1 - from.x(), y - from.y()) + std::hypot(p.x() - 1, p.y() - y);
      };
      EXPECT_GT(d.distances[v], (p - from).norm() * (1 + 1e-9)) << "the line through the wall";
      // Planes over bent fronts may lie a little below the way round an end of it.
      EXPECT_GT(d.distances[v], std::hypot(std::min(over(0.5), over(1)), p.z()) * 0.995);
      ++behind;
    }
  }
  EXPECT_GT(behind, 200);
}

TEST(TetMarching, SeesTheNearestOfSeveralSourcesInUnevenTets) {
  TetMesh box = make_box_tets(12, 12, 12, Vec3(1, 1, 1));
  Dice dice(5);
  std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
  for (Vec3& p : positions) {
    if (p.minCoeff() > 0 && p.maxCoeff() < 1) p += 0.025 * dice.in_cube();
  }
  const TetMesh rough = *TetMesh::build(positions, {box.tets().begin(), box.tets().end()});
  const auto marching = marching_on(rough);
  for (const int count : {2, 2, 2, 5, 5, 12}) {
    std::vector<Index> sources;
    for (int i = 0; i < count; ++i) {
      sources.push_back(static_cast<Index>(dice.between(0, rough.vertex_count() - 1)));
    }
    const DistanceResult d = marched(*marching, SourceSet::of_vertices(sources));
    for (Index v = 0; v < rough.vertex_count(); ++v) {
      double line = kUnreached;
      for (const Index s : sources) line = std::min(line, (positions[s] - positions[v]).norm());
      ASSERT_LE(d.distances[v], line * 1.01 + 1e-12) << v << " of " << count;
    }
  }
}

TEST(TetMarching, ObtuseAndUnevenTetsDoNotMatter) {
  TetMesh box = make_box_tets(8, 8, 8, Vec3(1, 1, 1));
  Dice dice(5);
  std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
  for (Vec3& p : positions) {
    const bool inside = p.minCoeff() > 0 && p.maxCoeff() < 1;
    if (inside) p += 0.02 * dice.in_cube();
  }
  const TetMesh rough = *TetMesh::build(positions, {box.tets().begin(), box.tets().end()});
  EXPECT_LT(error_from_first(rough, kUnreached), 1e-12);
  EXPECT_LT(error_from_first(rough, 0.25), 0.05);
  std::vector<Vec3> flat = positions;
  for (Vec3& p : flat) p.z() *= 0.05;
  const TetMesh plate = *TetMesh::build(flat, {box.tets().begin(), box.tets().end()});
  EXPECT_LT(error_from_first(plate, 0.25), 0.1);
}

TEST(TetMarching, KnowsSeveralSourcesOffsetsAndPointsInside) {
  const TetMesh box = make_box_tets(6, 6, 6, Vec3(1, 1, 1));
  const Index vertex = 72;  // of the inner ones
  const Vec3 a = box.positions()[vertex], b(0.8, 0.9, 0.7);
  const VolumePoint inside = closest_point(box, b)->point;
  SourceSet sources = in_tet(inside.tet, {inside.weights.begin(), inside.weights.end()});
  sources.points = {SurfacePoint::at_vertex(vertex)};
  sources.offsets = {0.25};
  const DistanceResult d = marched(*marching_on(box), sources);
  for (Index v = 0; v < box.vertex_count(); ++v) {
    const double from_a = 0.25 + (box.positions()[v] - a).norm();
    const double from_b = (box.positions()[v] - b).norm();
    EXPECT_NEAR(d.distances[v], std::min(from_a, from_b), 1e-13);
    if (std::abs(from_a - from_b) > 1e-9) {
      EXPECT_EQ(d.nearest_source[v], from_a < from_b ? 0 : 1);
    }
  }
}

TEST(TetMarching, DoesNotReachOtherComponents) {
  const TetMesh mesh = slab(4, [](const Vec3& p) { return p.x() > 0.5 && p.x() < 1; });
  const DistanceResult d = marched(*marching_on(mesh), SourceSet::of_vertices({0}));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(d.distances[v] < kUnreached, mesh.positions()[v].x() <= 0.5);
    EXPECT_EQ(d.nearest_source[v], mesh.positions()[v].x() <= 0.5 ? 0 : kNoIndex);
  }
}

TEST(TetMarching, SaysWhatIsWrongWithItsSources) {
  const auto marching = marching_on(make_box_tets(1, 1, 1, Vec3(1, 1, 1)));
  const auto said = [&marching](const SourceSet& sources) {
    const auto d = marching->solve(sources);
    return d ? "" : sentence(d.error());
  };
  EXPECT_EQ(said({}), "there is no source");
  EXPECT_EQ(said(SourceSet::of_vertices({8})), "source vertex 8 is not one of 8 vertices");
  EXPECT_EQ(said(in_tet(6, {1, 0, 0, 0})), "source tet 6 is not there, or was left out");
  EXPECT_EQ(said(in_tet(2, {1, 1, 0, 0})),
            "the source in tet 2 needs 4 weights that are not negative and sum to 1");
  const auto flat =
      build_tet_marching(std::make_shared<const TetMesh>(*TetMesh::build(
                             {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}})),
                         1);
  EXPECT_EQ(sentence(flat.error()), "none of the 1 tetrahedra has a volume");
}

}  // namespace
}  // namespace geotherm::test
