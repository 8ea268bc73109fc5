// SPDX-License-Identifier: MIT
// What is known around sources without heat, and that no answer is below the straight line.
#include "solver/heat/near_march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geotherm/build_method.h"
#include "tests/support/cells.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// Lengths that were computed on the way from the source, a rounding at every face.
constexpr double kUnfolded = 1e-12;
// Ways between corners of which one is farther than the vertex itself are missed: the way along an
// edge is then up to 1 / cos(30 degrees) as long for its last piece, one of several.
constexpr double kMissed = 0.03, kMissedInTheMean = 0.003;

/// A mesh as marches take it.
struct Marched {
  CornerTable corners;
  std::vector<FaceLayout> layout;

  explicit Marched(const TriangleMesh& mesh) : corners(mesh.vertex_count(), mesh.faces()) {
    for (const Face& f : mesh.faces()) {
      const auto length = [&](int k) {
        return (mesh.positions()[f[k]] - mesh.positions()[f[next_corner(k)]]).norm();
      };
      layout.push_back(lay_out({length(0), length(1), length(2)}));
    }
  }
};

TEST(NearMarch, IsNearExactInThePlane) {
  const auto mesh = finish(random_delaunay(3000, 5));
  const Marched marched(*mesh);
  const Vec3 middle(0.5, 0.5, 0);
  const auto from = static_cast<Index>(
      std::ranges::min_element(mesh->positions(), {},
                               [&](const Vec3& p) { return (p - middle).norm(); }) -
      mesh->positions().begin());
  const std::vector<NearDistance> seeds = {{from, 0.0}};
  const auto near = march_nearest(marched.corners, mesh->faces(), marched.layout, seeds, 500);
  ASSERT_EQ(near.size(), 500u);
  std::vector<double> all;
  for (const Vec3& p : mesh->positions()) all.push_back((p - mesh->positions()[from]).norm());
  double sum = 0;
  for (const NearDistance& each : near) {
    const double line = all[each.vertex];
    EXPECT_GE(each.distance, line * (1 - kUnfolded)) << "no way is shorter";
    EXPECT_LE(each.distance, line * (1 + kMissed));
    if (line > 0) sum += each.distance / line - 1;
  }
  EXPECT_LE(sum / 500, kMissedInTheMean);
  std::ranges::sort(all);
  EXPECT_NEAR(near.back().distance, all[499], kMissed * all[499]) << "they are the nearest ones";
}

TEST(NearMarch, IsExactWhereNoCornerIsObtuse) {
  const auto mesh = finish(plane_grid(40, 40, 1, 1));
  const Marched marched(*mesh);
  const Index from = grid_vertex(40, 20, 20);
  const std::vector<NearDistance> seeds = {{from, 0.0}};
  for (const NearDistance& each :
       march_nearest(marched.corners, mesh->faces(), marched.layout, seeds, 500)) {
    EXPECT_NEAR(each.distance, (mesh->positions()[each.vertex] - mesh->positions()[from]).norm(),
                kUnfolded);
  }
}

TEST(NearMarch, IsExactAroundTheTipOfACone) {
  const Index sectors = 5, rings = 12;
  const auto mesh = finish(pyramid(sectors, rings, M_PI / 3));
  const Marched marched(*mesh);
  const std::vector<NearDistance> seeds = {{0, 0.0}};
  const auto near = march_nearest(marched.corners, mesh->faces(), marched.layout, seeds, 100);
  for (const NearDistance& each : near) {
    EXPECT_NEAR(each.distance, (mesh->positions()[each.vertex] - mesh->positions()[0]).norm(),
                kUnfolded);
  }
}

TEST(NearField, IsNearExactBesideSourcesInThePlane) {
  const auto mesh = finish(jittered_plane(60, 0.2, 3));
  const Index source = grid_vertex(60, 30, 30);
  const auto distances = solve(mesh, {source}).distances;
  HeatOptions classic;
  classic.variant = Variant::kClassic;
  const auto published = solve(mesh, {source}, classic).distances;
  // A disc of as many vertices in a square of 61 x 61: half of its radius is sure.
  const double share = static_cast<double>(near_count(1, mesh->face_count())) / (60 * 60);
  const double sure = std::sqrt(share / M_PI) / 2;
  int count = 0;
  double off = 0;
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const double line = (mesh->positions()[v] - mesh->positions()[source]).norm();
    if (line > 0.9 * sure) continue;
    ++count;
    EXPECT_NEAR(distances[v], line, kMissed * line) << "vertex " << v;
    off = std::max(off, std::abs(published[v] - line));
  }
  EXPECT_GT(count, 20);
  EXPECT_GT(off, kMissed * sure) << "the variant classic is the method as published";
}

TEST(NearField, CountsAPointInAFaceAsOneSource) {
  const auto mesh = finish(jittered_plane(80, 0.2, 3));
  SourceSet points;
  for (Index i = 0; i < 30; ++i) {
    points.points.push_back(SurfacePoint::in_face(400 * i + 7, {0.3, 0.3, 0.4}));
  }
  const auto distances = solve(method_of(mesh), points).distances;
  // Beside each its line is the answer: as many corners as would be too many sources have it.
  for (const SurfacePoint& point : points.points) {
    const Face& corners = mesh->faces()[point.face];
    Vec3 place = Vec3::Zero();
    for (int k = 0; k < 3; ++k) place += point.weights[k] * mesh->positions()[corners[k]];
    for (const Index v : corners) {
      const double line = (mesh->positions()[v] - place).norm();
      EXPECT_NEAR(distances[v], line, kUnfolded + kMissed * line) << "vertex " << v;
    }
  }
}

TEST(NearField, IsTheSameInAnyUnitWhereWaysAlongEdgesAreEqual) {
  // A square of squares whose diagonals alternate, one vertex far above it, so that vertices are
  // inserted and waves walk around the source.
  constexpr Index kSide = 9, kAbove = 68, kSource = 57;
  const auto spike = [&](double unit) {
    Draft draft;
    for (Index i = 0; i < kSide * kSide; ++i) {
      draft.positions.push_back(unit / (kSide - 1) * Vec3(i / kSide, i % kSide, 0));
    }
    draft.positions[kAbove].z() += unit / 2;
    for (Index i = 0; i + 1 < kSide; ++i) {
      for (Index j = 0; j + 1 < kSide; ++j) {
        const Index a = i * kSide + j, b = a + kSide, c = b + 1, d = a + 1;
        const bool rises = (i + j) % 2 == 1;
        draft.faces.push_back({a, b, rises ? c : d});
        draft.faces.push_back(rises ? Face{a, c, d} : Face{b, c, d});
      }
    }
    return solve(finish(draft), {kSource}).distances;
  };
  const std::vector<double> reference = spike(1);
  for (const double unit : {0.3, 0.7, 3.0}) {
    std::vector<double> distances = spike(unit);
    for (double& distance : distances) distance /= unit;
    EXPECT_LE(relative_difference(distances, reference), 1e-9) << "unit " << unit;
  }
}

TEST(NearField, IsLeftOutAroundCurves) {
  const auto mesh = finish(plane_grid(40, 40, 1, 1));
  SourceSet curve;
  for (Index i = 0; i < 40; ++i)
    curve.edges.push_back({grid_vertex(40, 20, i), grid_vertex(40, 20, i + 1)});
  const auto distances = solve(method_of(mesh), curve).distances;
  // Circles around the corners of the curve would be wrong between them.
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    EXPECT_NEAR(distances[v], std::abs(mesh->positions()[v].x() - 0.5), 1e-3);
  }
}

TEST(StraightLines, NoAnswerIsBelowThem) {
  for (const ZooMesh& each : zoo(kRegular)) {
    SCOPED_TRACE(each.name);
    const auto mesh = each.mesh();
    const std::vector<Index> sources = {mesh->faces().front()[0], mesh->faces().back()[1]};
    const auto distances = solve(mesh, sources).distances;
    for (Index v = 0; v < mesh->vertex_count(); ++v) {
      double line = kUnreached;
      for (const Index s : sources) {
        line = std::min(line, (mesh->positions()[v] - mesh->positions()[s]).norm());
      }
      EXPECT_GE(distances[v], line * (1 - kUnfolded)) << "vertex " << v;
    }
  }
}

TEST(StraightLines, DoNotCountWhereLengthsAreNotTheirs) {
  // A ring that is drawn as a line.
  Graph ring{100, {}};
  for (Index v = 0; v < 100; ++v) ring.edges.push_back({v, (v + 1) % 100, 1.0});
  auto cells = cells_of(ring);
  ASSERT_TRUE(cells);
  for (Index v = 0; v < 100; ++v) cells->positions.emplace_back(v, 0, 0);
  const auto result = solve_cells(shared(std::move(cells)), SourceSet::of_vertices({0}));
  EXPECT_NEAR(result.distances[99], 1, 0.1);
  EXPECT_NEAR(result.distances[75], 25, 1);
  EXPECT_EQ(result.quality.below_straight_line, 0);
}

}  // namespace
}  // namespace geotherm::test
