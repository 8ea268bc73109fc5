// SPDX-License-Identifier: MIT
// Curves of mesh edges: the distance on the plane is that to the polyline.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// Largest error over the largest distance. At the curve's bends and ends a front is part straight
// and part round, and a fit through samples of both is neither: a share of an edge, of which there
// are twenty. Fast marching is of first order: measured
// 0.047.
const std::map<MethodKind, double> kLargest = {{MethodKind::kWavefront, 0.005},
                                               {MethodKind::kWavefrontFine, 0.002},
                                               {MethodKind::kFastMarching, 0.08}};

double to_piece(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - t * ab).norm();
}

/// Edges of the mesh from face to face: the sides of some faces, which bend and branch.
std::vector<std::array<Index, 2>> some_edges(const TriangleMesh& mesh) {
  std::vector<std::array<Index, 2>> edges;
  for (const Index f : {mesh.face_count() / 3, mesh.face_count() / 3 + 1, mesh.face_count() / 2}) {
    const Face& face = mesh.faces()[f];
    edges.push_back({face[0], face[1]});
    edges.push_back({face[1], face[2]});
  }
  return edges;
}

class PlanarCurves : public testing::TestWithParam<std::tuple<ZooMesh, MethodKind>> {};

TEST_P(PlanarCurves, AreMeasuredFromTheirNearestPoint) {
  const auto& [zoo_mesh, kind] = GetParam();
  const MeshPtr mesh = zoo_mesh.mesh();
  SourceSet curve;
  curve.edges = some_edges(*mesh);
  std::vector<double> exact;
  for (const Vec3& p : mesh->positions()) {
    double least = kUnreached;
    for (const auto& [a, b] : curve.edges) {
      least = std::min(least, to_piece(p, mesh->positions()[a], mesh->positions()[b]));
    }
    exact.push_back(least);
  }
  const auto d = distances(mesh, kind, curve);
  EXPECT_LE(relative_difference(d, exact), kLargest.at(kind));
  for (const auto& [a, b] : curve.edges) {
    EXPECT_EQ(d[a], 0);
    EXPECT_EQ(d[b], 0);
  }
}

std::vector<ZooMesh> fine_planes() {
  std::vector<ZooMesh> out;
  for (const ZooMesh& mesh : zoo(kPlanar | kManifold | kConnected | kRegular)) {
    const std::string name = mesh.name;
    if (name != "one_triangle" && name != "long_strip") out.push_back(mesh);
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Zoo, PlanarCurves,
                         testing::Combine(testing::ValuesIn(fine_planes()),
                                          testing::ValuesIn(kWaveKinds)),
                         name_and_kind);

// The front of a straight curve from border to border is straight: exact for every method.
TEST(StraightCurves, SendStraightFronts) {
  constexpr Index kN = 12;
  const MeshPtr mesh = finish(plane_grid(kN, kN, 1, 1));
  SourceSet curve;
  for (Index i = 0; i < kN; ++i) {
    curve.edges.push_back({grid_vertex(kN, i, 0), grid_vertex(kN, i + 1, 0)});
  }
  for (const MethodKind kind : kWaveKinds) {
    const auto d = distances(mesh, kind, curve);
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      EXPECT_NEAR(d[v], mesh->positions()[v].y(), 1e-12) << kind_name(kind);
    }
  }
}

}  // namespace
}  // namespace geotherm::test
