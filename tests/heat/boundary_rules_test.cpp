// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/mesh_zoo.h"
#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// The bound is a share of the largest distance: rules change the heat beside the border, by
// more than round-off and by less than the few edges over which heat reaches.
constexpr double kDiffers = 1e-3;
constexpr double kAtMost = 0.15;
// What a rule may do to distances that no border is near.
constexpr double kInside = 0.03;
constexpr double kBoundaryRoundOff = 1e-9;

HeatOptions under(BoundaryRule rule, const std::string& backend = {}) {
  HeatOptions options;
  options.boundary = rule;
  options.backend = backend;
  return options;
}

class BoundaryRules : public testing::TestWithParam<std::string> {
 protected:
  static constexpr Index kN = 32;
  Draft draft = jittered_plane(kN, 0.2, 3);
  MeshPtr mesh = finish(draft);
  Index centre = grid_vertex(kN, kN / 2, kN / 2);

  DistanceResult from(Index source, BoundaryRule rule) const {
    return solve(mesh, {source}, under(rule, GetParam()));
  }
  double largest_difference(BoundaryRule a, BoundaryRule b, double within) const {
    const auto d = from(centre, a).distances, e = from(centre, b).distances;
    double most = 0;
    for (std::size_t v = 0; v < d.size(); ++v) {
      const Vec3 p = draft.positions[v] - draft.positions[centre];
      if (p.cwiseAbs().maxCoeff() <= within) most = std::max(most, std::abs(d[v] - e[v]));
    }
    return most / largest(d);
  }
};

TEST_P(BoundaryRules, DifferBesideTheBorder) {
  const auto n = BoundaryRule::kNeumann, d = BoundaryRule::kDirichlet, a = BoundaryRule::kAverage;
  for (const auto& [x, y] : {std::pair{n, d}, {n, a}, {d, a}}) {
    EXPECT_GE(largest_difference(x, y, 1), kDiffers);
    EXPECT_LE(largest_difference(x, y, 1), kAtMost);
  }
}

TEST_P(BoundaryRules, MatterLittleInside) {
  EXPECT_LE(largest_difference(BoundaryRule::kNeumann, BoundaryRule::kDirichlet, 0.25), kInside);
  EXPECT_LE(largest_difference(BoundaryRule::kNeumann, BoundaryRule::kAverage, 0.25), kInside);
}

TEST_P(BoundaryRules, TakeSourcesOnTheBorder) {
  const Index source = grid_vertex(kN, kN / 2, 0);
  const auto reference = from(source, BoundaryRule::kNeumann).distances;
  for (const auto rule : {BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
    const auto result = from(source, rule);
    EXPECT_EQ(result.distances[source], 0);
    EXPECT_LE(relative_difference(result.distances, reference), kAtMost);
    // That the source's row is left free must be said where nothing else is drawn.
    EXPECT_EQ(result.warnings.empty(), rule == BoundaryRule::kAverage);
  }
}

// All neighbours of a corner may be held at 0: then no heat leaves it.
TEST_P(BoundaryRules, TakeASourceInACorner) {
  const auto result = from(0, BoundaryRule::kDirichlet);
  EXPECT_EQ(result.distances[0], 0);
  for (const double d : result.distances) EXPECT_TRUE(std::isfinite(d));
  EXPECT_FALSE(result.warnings.empty());
}

// One vertex wide, so that the border is all there is beside the source.
TEST_P(BoundaryRules, NameTheBorderWhereItCutsTheHeatOff) {
  const MeshPtr strip = finish(plane_grid(40, 1, 40, 1));
  const auto result = solve(strip, {7}, under(BoundaryRule::kDirichlet, GetParam()));
  const auto names_it = [](const Warning& warning) {
    const std::string w = sentence(warning);
    return w.find("77 of 80 faces (96.2 %)") != std::string::npos &&
           w.find("boundary neumann or average") != std::string::npos &&
           w.find("time-factor") == std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(result.warnings, names_it), 1);
}

// Faces between held corners have no gradient of heat, and none to lose.
TEST_P(BoundaryRules, LoseNoFaceThatLiesWithinTheBorder) {
  Draft square = jittered_plane(12, 0.2, 3);
  square.faces.push_back({0, 1, square.add({-0.1, -0.1, 0})});
  const auto result =
      solve(finish(square), {grid_vertex(12, 6, 6)}, under(BoundaryRule::kDirichlet, GetParam()));
  EXPECT_EQ(result.quality.zero_gradient_faces, 0);
}

// Where few sources are on the border, their equations are met through the factor of the border
// that is held; cg has a matrix for each set in which they are free.
TEST_P(BoundaryRules, FreeSourcesOnTheBorderAsAMatrixOfTheirOwnDoes) {
  constexpr double kIterative = 1e-6;
  const Index middle = grid_vertex(kN, kN / 2, 0), corner = grid_vertex(kN, kN, kN);
  SourceSet in_face;
  in_face.points = {SurfacePoint::in_face(3, {0.5, 0.3, 0.2})};
  const std::vector<SourceSet> sets = {
      SourceSet::of_vertices({middle}), SourceSet::of_vertices({corner}),
      SourceSet::of_vertices({middle, centre, corner, middle + 1, middle + 2}),
      SourceSet::of_vertices({centre}), in_face};
  for (const auto rule : {BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
    const auto shared = HeatMethod::build(mesh, under(rule, GetParam()));
    const auto own = HeatMethod::build(mesh, under(rule, "cg"));
    ASSERT_TRUE(shared && own);
    const auto results = shared->solve_each(sets);
    ASSERT_TRUE(results);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      EXPECT_LE(relative_difference((*results)[i].distances, solve(*own, sets[i]).distances),
                kIterative)
          << "set " << i;
    }
  }
}

TEST_P(BoundaryRules, TakeAWholeBorderOfSources) {
  std::vector<Index> border;
  for (Index i = 0; i < kN; ++i) {
    border.insert(border.end(), {grid_vertex(kN, i, 0), grid_vertex(kN, kN, i),
                                 grid_vertex(kN, i + 1, kN), grid_vertex(kN, 0, i + 1)});
  }
  const auto d = solve(mesh, border, under(BoundaryRule::kDirichlet, GetParam())).distances;
  for (std::size_t v = 0; v < d.size(); ++v) {
    const Vec3& p = draft.positions[v];
    const double exact = std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()});
    EXPECT_NEAR(d[v], exact, kAtMost / 2) << "vertex " << v;
  }
}

TEST_P(BoundaryRules, AreOneOnAClosedSurface) {
  const MeshPtr closed = finish(torus(24, 12, 0.4));
  const auto neumann = solve(closed, {7}, under(BoundaryRule::kNeumann, GetParam())).distances;
  for (const auto rule : {BoundaryRule::kDirichlet, BoundaryRule::kAverage}) {
    EXPECT_LE(relative_difference(solve(closed, {7}, under(rule, GetParam())).distances, neumann),
              kBoundaryRoundOff);
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, BoundaryRules, testing::ValuesIn(backend_names()),
                         backend_test_name);

}  // namespace
}  // namespace geotherm::test
