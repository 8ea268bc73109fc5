// SPDX-License-Identifier: MIT
#include "geotherm/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geotherm/mesh_report.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

/// Sums of some hundred terms that are rounded each.
constexpr double kSum = 1e-12;

Vec3 place(const TriangleMesh& mesh, const SurfacePoint& point) {
  Vec3 p = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    p += point.weights[k] * mesh.positions()[mesh.faces()[point.face][k]];
  }
  return p;
}

class SubdividedZoo : public testing::TestWithParam<ZooMesh> {};

TEST_P(SubdividedZoo, IsTheSameSurfaceWithTheSameFirstVertices) {
  const MeshPtr mesh = GetParam().mesh();
  const auto fine = subdivide(*mesh, 2);
  ASSERT_TRUE(fine) << fine.error().message;
  ASSERT_EQ(fine->face_count(), 16 * mesh->face_count());
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    EXPECT_EQ(fine->positions()[v], mesh->positions()[v]);
  }
  const MeshReport a = inspect_mesh(*mesh), b = inspect_mesh(*fine);
  EXPECT_NEAR(b.area, a.area, kSum * a.area);
  EXPECT_EQ(b.components, a.components);
  EXPECT_EQ(b.euler_characteristic, a.euler_characteristic);
  EXPECT_EQ(b.boundary_edges, 4 * a.boundary_edges);
  EXPECT_EQ(b.nonmanifold_edges, 4 * a.nonmanifold_edges);
  EXPECT_EQ(b.unreferenced_vertices, a.unreferenced_vertices);
}

INSTANTIATE_TEST_SUITE_P(Meshes, SubdividedZoo, testing::ValuesIn(zoo()), zoo_name);

TEST(Subdivide, KeepsPointsWhereTheyAre) {
  const MeshPtr mesh = finish(sphere(1));
  const auto fine = subdivide(*mesh, 3);
  ASSERT_TRUE(fine);
  for (const std::array<double, 3> weights : {std::array{1.0, 0.0, 0.0},
                                              {0.0, 0.5, 0.5},
                                              {0.2, 0.0, 0.8},
                                              {0.4, 0.3, 0.3},
                                              {0.1, 0.15, 0.75},
                                              {1.0 / 3, 1.0 / 3, 1.0 / 3}}) {
    const SurfacePoint point = SurfacePoint::in_face(7, weights);
    const SurfacePoint there = subdivided_point(point, 3);
    EXPECT_LE((place(*fine, there) - place(*mesh, point)).norm(), kSum);
    EXPECT_GE(std::ranges::min(there.weights), 0);
    if (std::ranges::min(weights) == 0) {
      EXPECT_EQ(std::ranges::min(there.weights), 0) << "on an edge";
    }
  }
  EXPECT_EQ(subdivided_point(SurfacePoint::at_vertex(5), 3).vertex, 5);
}

TEST(Subdivide, LinesUpTheVerticesOfASide) {
  const MeshPtr mesh = finish(plane_grid(2, 2, 2, 2));
  const auto fine = subdivide(*mesh, 2);
  ASSERT_TRUE(fine);
  for (Index f = 0; f < mesh->face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto line = subdivided_side(fine->faces(), f, k, 2);
      ASSERT_EQ(line.size(), 5U);
      const Vec3& a = mesh->positions()[mesh->faces()[f][k]];
      const Vec3& b = mesh->positions()[mesh->faces()[f][(k + 1) % 3]];
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(fine->positions()[line[i]], a + (b - a) * (static_cast<double>(i) / 4));
      }
    }
  }
}

TEST(Subdivide, RefusesMoreFacesThanCanBeNumbered) {
  const MeshPtr mesh = finish(sphere(1));  // 80 faces
  const auto none = subdivide(*mesh, 12);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(none.error()).find("at most 11 times, to 335544320 faces"), std::string::npos)
      << none.error().message;
  EXPECT_FALSE(subdivide(*mesh, -1));
  EXPECT_FALSE(subdivide(*mesh, std::numeric_limits<int>::max()));
}

}  // namespace
}  // namespace geotherm::test
