// SPDX-License-Identifier: MIT
// Curves along edges and across faces: the distance on the plane is that to the polyline.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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

using Line = std::pair<Vec3, Vec3>;
using BarycentricWeights = std::array<double, 3>;

/// Of a point of the plane z = 0 in the plane of a face, on either side of its sides.
BarycentricWeights weights_in(const TriangleMesh& mesh, Index f, const Vec3& p) {
  const Face& face = mesh.faces()[f];
  const auto twice_area = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a).z();
  };
  const Vec3 &a = mesh.positions()[face[0]], &b = mesh.positions()[face[1]],
             &c = mesh.positions()[face[2]];
  const double all = twice_area(a, b, c);
  return {twice_area(p, b, c) / all, twice_area(a, p, c) / all, twice_area(a, b, p) / all};
}

/// A place between two points; what rounding leaves beside a side is put on it.
BarycentricWeights between(const BarycentricWeights& a, const BarycentricWeights& b, double t) {
  BarycentricWeights out{};
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    out[k] = a[k] + t * (b[k] - a[k]);
    if (out[k] < 1e-12) out[k] = 0;
    sum += out[k];
  }
  for (double& weight : out) weight /= sum;
  return out;
}

/// Adds a line of the plane z = 0, face by face.
void add_line(SourceSet& set, const TriangleMesh& mesh, const Line& line, Index curve) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const BarycentricWeights from = weights_in(mesh, f, line.first),
                             to = weights_in(mesh, f, line.second);
    double begin = 0, end = 1;
    for (int k = 0; k < 3; ++k) {
      const double slope = to[k] - from[k];
      if (slope > 0) begin = std::max(begin, -from[k] / slope);
      if (slope < 0) end = std::min(end, -from[k] / slope);
    }
    if (end - begin < 1e-9) continue;
    set.segments.push_back({f, between(from, to, begin), between(from, to, end), curve});
  }
}

/// A plane whose triangles are `stretch` times as long as wide, and how many curves are on it.
struct StretchedPlane {
  const char* name;
  double jitter, stretch;
  int curves;
  unsigned seed;
};

class StretchedPlanes : public testing::TestWithParam<std::tuple<StretchedPlane, MethodKind>> {};

// Curves of two lines that end inside faces, and one along edges. Waves that were fitted to the
// distances along edges that a curve crosses were 0.2 to 4 % wrong on average.
TEST_P(StretchedPlanes, MeasureCurvesFromTheirNearestPoint) {
  const auto& [plane, kind] = GetParam();
  constexpr Index kCells = 30;
  Draft draft = plane.jitter > 0 ? jittered_plane(kCells, plane.jitter, plane.seed)
                                 : plane_grid(kCells, kCells, 1, 1);
  for (Vec3& p : draft.positions) p.x() *= plane.stretch;
  const MeshPtr mesh = finish(draft);
  std::mt19937 random(plane.seed);
  std::uniform_real_distribution<double> inside(0.02, 0.98);
  const auto any = [&] {
    const double x = inside(random), y = inside(random);
    return Vec3(plane.stretch * x, y, 0);
  };
  SourceSet set;
  std::vector<Line> lines;
  for (Index curve = 0; curve < plane.curves; ++curve) {
    const Vec3 a = any(), b = any(), c = any();
    for (const Line& line : {Line(a, b), Line(b, c)}) {
      add_line(set, *mesh, line, curve);
      lines.push_back(line);
    }
  }
  for (const auto& edge : some_edges(*mesh)) {
    set.edges.push_back(edge);
    lines.emplace_back(mesh->positions()[edge[0]], mesh->positions()[edge[1]]);
  }
  std::vector<double> exact;
  for (const Vec3& p : mesh->positions()) {
    double least = kUnreached;
    for (const auto& [a, b] : lines) least = std::min(least, to_piece(p, a, b));
    exact.push_back(least);
  }
  const ErrorPercent error = errors(distances(mesh, kind, set), exact);
  EXPECT_LE(error.mean, 0.1);
  EXPECT_LE(error.largest, 1.5);  // where fronts meet within an edge of the curves
}

INSTANTIATE_TEST_SUITE_P(
    Planes, StretchedPlanes,
    testing::Combine(testing::Values(StretchedPlane{"regular", 0, 1, 2, 1},
                                     StretchedPlane{"irregular", 0.3, 1, 1, 2},
                                     StretchedPlane{"ten_times", 0.3, 10, 1, 3},
                                     StretchedPlane{"thirty_times", 0, 30, 1, 4},
                                     StretchedPlane{"thirty_times_with_many_curves", 0, 30, 4, 5},
                                     StretchedPlane{"thirty_times_irregular", 0.3, 30, 1, 6}),
                     testing::ValuesIn(kRoundWaves)),
    name_and_kind);

class CurvesOnTheZoo : public MethodOnMesh {};

TEST_P(CurvesOnTheZoo, AreNearToExactDistances) {
  SourceSet set;
  set.edges = some_edges(*mesh);
  set.segments = {{mesh->face_count() / 4, {0.2, 0.7, 0.1}, {0, 0.3, 0.7}, 0}};
  const auto exact = distances(mesh, MethodKind::kExact, set);
  const ErrorPercent error = errors(solve(*method, set).distances, exact);
  EXPECT_LE(error.mean, 0.1);
  EXPECT_LE(error.largest, 1);
}

INSTANTIATE_TEST_SUITE_P(Smooth, CurvesOnTheZoo,
                         testing::Combine(testing::ValuesIn(zoo(kSmooth)),
                                          testing::ValuesIn(kRoundWaves)),
                         name_and_kind);

TEST_P(CurvesOnTheZoo, LeaveTheBitsOfOtherQueries) {
  SourceSet set;
  set.edges = some_edges(*mesh);
  const auto all = solve(*method, set, {.quality = false}).distances;
  const double most = *std::ranges::max_element(all);
  for (const double share : {0.02, 0.3}) {
    const auto few = solve(
        *method, set, {.quality = false, .reach = {.max_distance = share * most, .sparse = true}});
    EXPECT_EQ(std::ssize(few.vertices),
              std::ranges::count_if(all, [&](double d) { return d <= share * most; }));
    for (std::size_t i = 0; i < few.vertices.size(); ++i) {
      EXPECT_EQ(few.distances[i], all[few.vertices[i]]);
    }
    const auto point = SourceSet::of_vertices({0});
    EXPECT_EQ(solve(*method, point).distances, distances(mesh, kind, point));
  }
}

}  // namespace
}  // namespace geotherm::test
