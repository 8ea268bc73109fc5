// SPDX-License-Identifier: MIT
// Sources inside faces and on edges, also of meshes whose edges were flipped.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

#include "geotherm/path.h"
#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"

namespace geotherm::test {
namespace {

// Shares of the range. The start measures straight distances in the faces at the source, and waves
// are round on the plane, but fits through samples that are not final yet may fall short: 1e-4 on
// well-shaped meshes of twenty edges, 1e-3 on flat ones of a dozen faces.
constexpr double kRound = 3e-3;
// First order: measured 0.085.
constexpr double kPointsFirstOrder = 0.15;

class PlanarPoints : public MethodOnMesh {
 protected:
  double tolerance = kind == MethodKind::kFastMarching ? kPointsFirstOrder : kRound;

  void expect_straight(const SurfacePoint& point) const {
    const auto d = solve(*method, {{point}, {}}).distances;
    std::vector<double> exact;
    for (const Vec3& p : mesh->positions()) {
      exact.push_back((p - position_at(*mesh, point)).norm());
    }
    EXPECT_LE(relative_difference(d, exact), tolerance) << "face " << point.face;
  }
};

TEST_P(PlanarPoints, InsideFacesSendRoundWaves) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.05, 1);
  for (int i = 0; i < 10; ++i) {
    const auto face = static_cast<Index>(random() % static_cast<unsigned>(mesh->face_count()));
    const double a = share(random), b = share(random), c = share(random), sum = a + b + c;
    expect_straight(SurfacePoint::in_face(face, {a / sum, b / sum, c / sum}));
  }
}

TEST_P(PlanarPoints, OnEdgesSendRoundWaves) {
  std::mt19937 random(6);
  for (int i = 0; i < 10; ++i) {
    const auto face = static_cast<Index>(random() % static_cast<unsigned>(mesh->face_count()));
    std::array<double, 3> weights{};
    weights[i % 3] = 0.3;
    weights[(i + 1) % 3] = 0.7;
    expect_straight(SurfacePoint::in_face(face, weights));
  }
}

TEST_P(PlanarPoints, AtCornersAreVertices) {
  const auto as_vertex = distances(mesh, kind, SourceSet::of_vertices({mesh->faces()[3][1]}));
  for (const double off : {0.0, 1e-13}) {
    const SurfacePoint corner = SurfacePoint::in_face(3, {off, 1 - off, 0});
    EXPECT_EQ(distances(mesh, kind, {{corner}, {}}), as_vertex);
  }
}

std::vector<ZooMesh> convex_planes() {
  std::vector<ZooMesh> out;
  for (const ZooMesh& mesh : zoo(kPlanar | kManifold | kConnected | kRegular)) {
    const std::string name = mesh.name;
    if (name != "one_triangle") out.push_back(mesh);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Zoo, PlanarPoints,
                         testing::Combine(testing::ValuesIn(convex_planes()),
                                          testing::ValuesIn(kWaveKinds)),
                         name_and_kind);

// The same point named from either face of its edge is one source.
TEST(PointsOnEdges, AreTheSameFromBothFaces) {
  const MeshPtr mesh = finish(sphere(3));
  const Face face = mesh->faces()[40];
  for (Index other = 0; other < mesh->face_count(); ++other) {
    std::array<double, 3> weights{};
    int shared = 0;
    for (int k = 0; k < 3; ++k) {
      if (mesh->faces()[other][k] == face[0]) weights[k] = 0.25, ++shared;
      if (mesh->faces()[other][k] == face[1]) weights[k] = 0.75, ++shared;
    }
    if (other == 40 || shared != 2) continue;
    for (const MethodKind kind : kWaveKinds) {
      const auto here = distances(mesh, kind, {{SurfacePoint::in_face(40, {0.25, 0.75, 0})}, {}});
      const auto there = distances(mesh, kind, {{SurfacePoint::in_face(other, weights)}, {}});
      EXPECT_LE(relative_difference(there, here), 1e-12) << kind_name(kind);
    }
  }
}

}  // namespace
}  // namespace geotherm::test
