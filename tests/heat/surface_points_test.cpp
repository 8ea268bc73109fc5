// SPDX-License-Identifier: MIT
// Sources that are not vertices: points in faces and on edges.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Two ways to name one point differ in rounding only.
constexpr double kSamePoint = 1e-12;
// Errors of the discretisation, in mean edges.
constexpr double kPointEdges = 1.0;

Vec3 place(const TriangleMesh& mesh, const SurfacePoint& point) {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    p += point.weights[k] * mesh.positions()[mesh.faces()[point.face][k]];
  }
  return p;
}

SourceSet at(const SurfacePoint& point) { return {{point}, {}}; }

class SurfacePoints : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
  HeatMethod method = method_of(mesh);
};

TEST_P(SurfacePoints, AtACornerAreThatVertex) {
  const Index f = mesh->face_count() / 2;
  for (int k = 0; k < 3; ++k) {
    std::array<double, 3> weights{};
    weights[k] = 1;
    EXPECT_EQ(solve(method, at(SurfacePoint::in_face(f, weights))).distances,
              solve(method, at(SurfacePoint::at_vertex(mesh->faces()[f][k]))).distances);
  }
}

TEST_P(SurfacePoints, VeryNearACornerAreNearlyThatVertex) {
  const Index f = mesh->face_count() / 2;
  const auto near = solve(method, at(SurfacePoint::in_face(f, {1 - 2e-9, 1e-9, 1e-9}))).distances;
  const auto there = solve(method, at(SurfacePoint::at_vertex(mesh->faces()[f][0]))).distances;
  // The neighbouring faces are not those that hold the point: errors differ by those of an edge.
  EXPECT_LE(relative_difference(near, there), 0.05);
}

TEST_P(SurfacePoints, TakeWeightsThatSumToOneNearly) {
  const Index f = mesh->face_count() / 3;
  const auto exact = solve(method, at(SurfacePoint::in_face(f, {0.25, 0.5, 0.25}))).distances;
  const auto typed = solve(method, at(SurfacePoint::in_face(f, {0.2500001, 0.5, 0.25}))).distances;
  EXPECT_LE(relative_difference(typed, exact), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Zoo, SurfacePoints, testing::ValuesIn(zoo(kSmooth)), zoo_name);

struct PlaneCase {
  const char* name;
  Draft (*draft)();
};
void PrintTo(const PlaneCase& c, std::ostream* out) { *out << c.name; }

/// In the plane the distance to any point is known; the border stays far away.
class PointsInThePlane : public testing::TestWithParam<PlaneCase> {
 protected:
  MeshPtr mesh = finish(GetParam().draft());
  HeatMethod method = method_of(mesh);
  double mean_edge = std::sqrt(method.t());

  /// Largest error within 0.35 of the point, in mean edges.
  double error(const SurfacePoint& point) const {
    const auto d = solve(method, at(point)).distances;
    const Vec3 p = place(*mesh, point);
    double most = 0;
    for (std::size_t v = 0; v < d.size(); ++v) {
      const double exact = (mesh->positions()[v] - p).norm();
      if (exact < 0.35) most = std::max(most, std::abs(d[v] - exact));
    }
    return most / mean_edge;
  }
  /// The face whose middle is nearest to the middle of the square.
  Index middle_face() const {
    Index best = 0;
    double least = 10;
    for (Index f = 0; f < mesh->face_count(); ++f) {
      const Vec3 p = place(*mesh, SurfacePoint::in_face(f, {1.0 / 3, 1.0 / 3, 1.0 / 3}));
      const double away = (p - Vec3(0.5, 0.5, 0)).norm();
      if (away < least) std::tie(best, least) = std::pair(f, away);
    }
    return best;
  }
};

TEST_P(PointsInThePlane, InsideAFaceAreWhereTheyAre) {
  EXPECT_LE(error(SurfacePoint::in_face(middle_face(), {0.2, 0.3, 0.5})), kPointEdges);
  EXPECT_LE(error(SurfacePoint::in_face(middle_face(), {0.7, 0.2, 0.1})), kPointEdges);
}

TEST_P(PointsInThePlane, OnAnEdgeAreWhereTheyAre) {
  EXPECT_LE(error(SurfacePoint::in_face(middle_face(), {0.4, 0.6, 0})), kPointEdges);
  EXPECT_LE(error(SurfacePoint::in_face(middle_face(), {0, 0.5, 0.5})), kPointEdges);
}

TEST_P(PointsInThePlane, OnAnEdgeAreTheSameFromBothFaces) {
  const Index f = middle_face();
  const Face& face = mesh->faces()[f];
  for (Index g = 0; g < mesh->face_count(); ++g) {
    const Face& other = mesh->faces()[g];
    const auto a = std::ranges::find(other, face[0]), b = std::ranges::find(other, face[1]);
    if (g == f || a == other.end() || b == other.end()) continue;
    std::array<double, 3> weights{};
    weights[static_cast<std::size_t>(a - other.begin())] = 0.3;
    weights[static_cast<std::size_t>(b - other.begin())] = 0.7;
    const auto here = solve(method, at(SurfacePoint::in_face(f, {0.3, 0.7, 0}))).distances;
    const auto there = solve(method, at(SurfacePoint::in_face(g, weights))).distances;
    EXPECT_LE(relative_difference(there, here), kSamePoint);
  }
}

TEST_P(PointsInThePlane, AndVerticesTogetherDoNotDependOnTheirOrder) {
  const Index f = middle_face();
  const SurfacePoint inside = SurfacePoint::in_face(f, {0.2, 0.3, 0.5});
  const SurfacePoint corner = SurfacePoint::at_vertex(mesh->faces()[f][1]);
  const auto a = solve(method, {{inside, corner}, {}}).distances;
  const auto b = solve(method, {{corner, inside}, {}}).distances;
  EXPECT_LE(relative_difference(a, b), kSamePoint);
}

const PlaneCase kPlanes[] = {
    {"grid", [] { return plane_grid(32, 32, 1, 1); }},
    {"irregular", [] { return jittered_plane(32, 0.3, 5); }},
    {"flipped",  // every second column of vertices moved up: long thin triangles, flipped
     [] {
       Draft draft = plane_grid(32, 32, 1, 1);
       for (Vec3& p : draft.positions) {
         const bool inner = p.y() > 0.01 && p.y() < 0.99;
         if (inner && std::lround(p.x() * 32) % 2 == 1) p.y() += 0.9 / 32 * (1 - p.y());
       }
       return draft;
     }},
};
INSTANTIATE_TEST_SUITE_P(Planes, PointsInThePlane, testing::ValuesIn(kPlanes),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace geotherm::test
