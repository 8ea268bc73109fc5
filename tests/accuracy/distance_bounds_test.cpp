// SPDX-License-Identifier: MIT
// Answers that are wrong on purpose, and right ones.
#include "solver/accuracy/distance_bounds.h"

#include <gtest/gtest.h>

#include "geotherm/build_method.h"
#include "solver/accuracy/check_waves.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr Index kCells = 40;

/// Right distances on a square of 40 x 40 cells of size 1, where the surface is the straight line.
class Bounds : public testing::TestWithParam<MethodKind> {
 protected:
  MeshPtr mesh = finish(plane_grid(kCells, kCells, kCells, kCells));
  std::shared_ptr<const WaveSurface> surface = *build_wave_surface(mesh);
  SourceSet sources = SourceSet::of_vertices({0});
  std::vector<double> right = [this] {
    std::vector<double> out;
    for (const Vec3& p : mesh->positions()) out.push_back(p.norm());
    return out;
  }();

  /// As a method judges its answer: in mean edges.
  DistanceResult judged(std::vector<double> distances) const {
    DistanceResult result;
    for (double& d : distances) d /= surface->base.mean_edge;
    result.distances = std::move(distances);
    assess_waves(GetParam(), *surface, sources, *seed_sources(*surface, sources), result);
    return result;
  }
};

TEST_P(Bounds, AreKeptByRightDistances) {
  const DistanceResult result = judged(right);
  EXPECT_EQ(result.quality.below_straight_line, 0);
  EXPECT_EQ(result.quality.steep_edges, 0);
  EXPECT_EQ(result.quality.most_below_straight_line, 0);
  EXPECT_EQ(result.quality.steepest_edge, 0);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.quality.reached_vertices, mesh->vertex_count());
}

TEST_P(Bounds, SeeDistancesThatAreTooShort) {
  // The farther half goes on as a plateau, as where heat knows no direction.
  std::vector<double> wrong = right;
  constexpr double kPlateau = 20;
  for (double& d : wrong) d = std::min(d, kPlateau);
  const BoundTolerance tolerance = bound_tolerance(GetParam());
  Index below = 0;
  double most = 0;
  for (const double line : right) {
    const double edge = surface->base.mean_edge;
    if (kPlateau + tolerance.line_edges * edge >= (1 - tolerance.line_share) * line) continue;
    ++below;
    most = std::max(most, 1 - kPlateau / line);
  }
  ASSERT_GT(below, 0);
  const DistanceResult result = judged(wrong);
  EXPECT_EQ(result.quality.below_straight_line, below);
  EXPECT_NEAR(result.quality.most_below_straight_line, most, 1e-12);
  EXPECT_EQ(result.quality.steep_edges, 0);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(sentence(result.warnings[0]).find(std::to_string(below) + " vertices ("),
            std::string::npos)
      << sentence(result.warnings[0]);
  EXPECT_NE(sentence(result.warnings[0]).find("straight line"), std::string::npos);
}

TEST_P(Bounds, SeeJumps) {
  // Beyond a line of vertices everything is farther by five cells: too long, which no straight line
  // tells. Edges across that line are too steep, but where the jump meets the way along the edge.
  std::vector<double> wrong = right;
  for (std::size_t v = 0; v < wrong.size(); ++v)
    wrong[v] += mesh->positions()[v].x() > 20.5 ? 5 : 0;
  const DistanceResult result = judged(wrong);
  EXPECT_EQ(result.quality.below_straight_line, 0);
  EXPECT_EQ(result.quality.steep_edges, 2 * kCells + 1);  // sides and diagonals across the line
  EXPECT_GT(result.quality.steepest_edge, 5);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(sentence(result.warnings[0]).find("edges"), std::string::npos);
}

TEST_P(Bounds, LeaveUnreachedVerticesOut) {
  std::vector<double> some = right;
  for (std::size_t v = 900; v < some.size(); ++v) some[v] = kUnreached;
  const DistanceResult result = judged(some);
  EXPECT_EQ(result.quality.reached_vertices, 900);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(ClampedVertices, ReachAsFarAsTheFarthestFromTheNearestSource) {
  const MeshPtr mesh = finish(plane_grid(kCells, kCells, kCells, kCells));
  const auto surface = build_wave_surface(mesh);
  ASSERT_TRUE(surface);
  DistanceResult result;
  for (const Vec3& p : mesh->positions()) result.distances.push_back(p.norm());
  for (const Vec3& zero : {Vec3(3, 4, 0), Vec3(1, 0, 0), Vec3(39, 40, 0)}) {
    for (std::size_t v = 0; v < result.distances.size(); ++v) {
      if (mesh->positions()[v] == zero) result.distances[v] = 0;
    }
  }
  const SourceSet corners = SourceSet::of_vertices({0, (kCells + 1) * (kCells + 1) - 1});
  const auto reach = [&](Index clamped) {
    result.quality.clamped_vertices = clamped;
    apply_straight_line_bound((*surface)->base, corners, 1, bound_tolerance(MethodKind::kHeat),
                              BelowLine::kKept, 1, result);
    return result.quality.clamped_reach;
  };
  EXPECT_NEAR(reach(3), 5, 1e-12);
  EXPECT_EQ(reach(0), 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, Bounds,
                         testing::Values(MethodKind::kWavefront, MethodKind::kWavefrontFine,
                                         MethodKind::kFastMarching, MethodKind::kExact));

/// All methods on whole meshes, also where vertices are one or faces are refined.
class BoundsOfMethods : public testing::TestWithParam<MethodKind> {
 protected:
  static void expect_kept(const MeshPtr& mesh, const SourceSet& sources, int refine) {
    MethodOptions options;
    options.method = GetParam();
    options.refine = refine;
    const auto method = build_method(mesh, options);
    ASSERT_TRUE(method);
    const auto result = (*method)->solve(sources);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->quality.below_straight_line, 0);
    EXPECT_EQ(result->quality.steep_edges, 0);
    EXPECT_GT(result->quality.reached_vertices, 0);
    const auto unjudged = (*method)->solve(sources, {.quality = false});
    ASSERT_TRUE(unjudged);
    EXPECT_EQ(unjudged->quality.reached_vertices, 0);
  }
};

TEST_P(BoundsOfMethods, AreKeptOnOrdinaryMeshes) {
  const MeshPtr round = finish(torus(60, 30, 0.4));
  expect_kept(round, SourceSet::of_vertices({5}), 0);
  expect_kept(round, SourceSet::of_vertices({5, 400, 900, 1300, 77, 1500, 620, 1010, 250}), 0);
  expect_kept(finish(jittered_plane(30, 0.3, 4)), SourceSet::of_vertices({17}), 0);
  SourceSet mixed;
  mixed.points = {SurfacePoint::in_face(40, {0.2, 0.3, 0.5})};
  mixed.edges = {{700, 701}, {701, 702}};
  expect_kept(round, mixed, 0);
}

TEST_P(BoundsOfMethods, AreThoseOfTheMeshThatIsSolvedOn) {
  expect_kept(finish(torus(24, 12, 0.4)), SourceSet::of_vertices({5}), 1);
  // Two halves of a plane whose vertices at the seam are one.
  Draft halves = plane_grid(10, 20, 10, 20);
  const auto half = static_cast<Index>(halves.positions.size());
  append(halves, transformed(plane_grid(10, 20, 10, 20), 1, {10, 0, 0}, false));
  std::vector<Index> same(halves.positions.size());
  for (std::size_t v = 0; v < same.size(); ++v) {
    same[v] = static_cast<Index>(v);
    for (Index w = 0; w < half && static_cast<Index>(v) >= half; ++w) {
      if (halves.positions[static_cast<std::size_t>(w)] == halves.positions[v]) same[v] = w;
    }
  }
  auto welded = TriangleMesh::build(halves.positions, halves.faces, same);
  ASSERT_TRUE(welded);
  const auto mesh = std::make_shared<const TriangleMesh>(*std::move(welded));
  expect_kept(mesh, SourceSet::of_vertices({half + 100}), 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, BoundsOfMethods,
                         testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                         MethodKind::kWavefrontFine, MethodKind::kFastMarching,
                                         MethodKind::kExact));

}  // namespace
}  // namespace geotherm::test
