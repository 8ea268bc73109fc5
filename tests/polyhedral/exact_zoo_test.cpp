// SPDX-License-Identifier: MIT
// What must hold on any mesh.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/polyhedral/exact_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

// Of symmetry: two runs over different faces.
constexpr double kSymmetry = 1e-9;
// Moved and turned, a mesh has other round-off in its coordinates.
constexpr double kMoved = 1e-9;

class ExactOnTheZoo : public testing::TestWithParam<ZooMesh> {
 protected:
  Draft draft = GetParam().draft();
  std::shared_ptr<const ExactMethod> method = exact_method(finish(draft));
  std::vector<Index> some = {draft.faces[0][0], draft.faces[draft.faces.size() / 3][1],
                             draft.faces[draft.faces.size() / 2][2], draft.faces.back()[1]};

  std::vector<double> from(const std::vector<Index>& sources) const {
    return solve_exactly(*method, SourceSet::of_vertices(sources)).distances;
  }
};

class ExactOnRegularMeshes : public ExactOnTheZoo {};

TEST_P(ExactOnTheZoo, IsANumberNotNegativeAndZeroAtTheSource) {
  for (const Index s : some) {
    const auto result = solve_exactly(*method, SourceSet::of_vertices({s}));
    EXPECT_EQ(result.distances[s], 0);
    EXPECT_EQ(result.quality.max_source_distance, 0);
    EXPECT_TRUE(std::isfinite(result.quality.eikonal_error_mean));
    for (const double d : result.distances) EXPECT_GE(d, 0);  // not for what is no number
  }
}

TEST_P(ExactOnTheZoo, IsSymmetric) {
  for (const Index a : some) {
    const auto d = from({a});
    for (const Index b : some) {
      const double back = from({b})[a];
      if (d[b] == back) continue;  // infinities too
      EXPECT_NEAR(d[b], back, kSymmetry * largest(d)) << a << " and " << b;
    }
  }
}

TEST_P(ExactOnTheZoo, SatisfiesTheTriangleInequality) {
  const auto d0 = from({some[0]});
  for (const Index middle : some) {
    const auto d1 = from({middle});
    for (std::size_t v = 0; v < d0.size(); ++v) {
      EXPECT_LE(d0[v], (d0[middle] + d1[v]) * (1 + kRoundOff)) << "vertex " << v;
    }
  }
}

TEST_P(ExactOnRegularMeshes, LiesBetweenTheStraightLineAndTheEdges) {
  const auto d = from({some[1]});
  for (std::size_t v = 0; v < d.size(); ++v) {
    const double line = (draft.positions[v] - draft.positions[some[1]]).norm();
    EXPECT_GE(d[v], line * (1 - kRoundOff)) << "vertex " << v;
  }
  for (const Face& face : draft.faces) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[(k + 1) % 3];
      if (d[a] == d[b]) continue;  // infinities too
      const double edge = (draft.positions[a] - draft.positions[b]).norm();
      EXPECT_LE(std::abs(d[a] - d[b]), edge * (1 + kRoundOff) + kRoundOff * largest(d));
    }
  }
}

TEST_P(ExactOnRegularMeshes, GrowsWithTheModelAndDoesNotDependOnItsPlace) {
  const auto d = from({some[2]});
  for (const double scale : {1e-9, 1.0, 1e9}) {
    auto other = exact_distances(finish(transformed(draft, scale, scale * Vec3(3, -8, 5), true)),
                                 std::vector<Index>{some[2]});
    for (double& x : other) x /= scale;
    EXPECT_LE(relative_difference(other, d), kMoved) << scale;
  }
}

TEST_P(ExactOnTheZoo, DoesNotDependOnTheNumbering) {
  const auto d = from({some[2]});
  std::vector<Index> number;
  const Draft other = renumbered(draft, 5, number);
  const auto moved = exact_distances(finish(other), std::vector<Index>{number[some[2]]});
  std::vector<double> back;
  for (const Index v : number) back.push_back(moved[v]);
  EXPECT_LE(relative_difference(back, d), kMoved);
}

TEST_P(ExactOnTheZoo, DoesNotDependOnTheOrderOfSources) {
  std::vector<Index> reversed(some.rbegin(), some.rend());
  reversed.push_back(some[0]);  // nor on naming one twice
  EXPECT_LE(relative_difference(from(reversed), from(some)), kRoundOff);
}

INSTANTIATE_TEST_SUITE_P(Zoo, ExactOnTheZoo, testing::ValuesIn(zoo()), zoo_name);
// Elsewhere lengths were added to all edges, by an amount that hangs on round-off.
INSTANTIATE_TEST_SUITE_P(Zoo, ExactOnRegularMeshes, testing::ValuesIn(zoo(kRegular)), zoo_name);

TEST(ExactOnTwoComponents, NeverReachesTheOther) {
  Draft draft = sphere(1);
  const Index first = draft.vertex_count();
  append(draft, transformed(torus(8, 5, 0.4), 1, Vec3(0.5, 0, 0), false));
  const auto result =
      solve_exactly(*exact_method(finish(draft)), SourceSet::of_vertices({0}), {.nearest = true});
  for (Index v = 0; v < draft.vertex_count(); ++v) {
    EXPECT_EQ(result.distances[v] == kUnreached, v >= first) << v;
    EXPECT_EQ(result.nearest_source[v], v >= first ? kNoIndex : 0) << v;
  }
}

TEST(ExactOnOneTriangle, IsTheLengthOfItsSides) {
  Draft draft;
  draft.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  draft.faces = {{0, 1, 2}};
  const auto d = exact_distances(finish(draft), std::vector<Index>{1});
  EXPECT_EQ(d[1], 0);
  EXPECT_NEAR(d[0], 3, kRoundOff);
  EXPECT_NEAR(d[2], 5, kRoundOff);
}

TEST(ExactOnSheetsThatPartAndMeet, DoesNotCountTheirWaysTwice) {
  // A strip in which every other cell is there three times: 3^30 ways from end to end.
  constexpr Index kLenses = 30;
  Draft draft = plane_grid(2 * kLenses, 1, 2 * kLenses, 1);
  for (Index i = 0; i < kLenses; ++i) {
    const Index a = grid_vertex(2 * kLenses, 2 * i, 0), b = a + 1;
    const Index d = grid_vertex(2 * kLenses, 2 * i, 1), c = d + 1;
    for (const double up : {0.3, -0.3}) {
      // Folded along the middle, so that it is longer.
      const Index m = draft.add(Vec3(2 * i + 0.5, 0, up)), n = draft.add(Vec3(2 * i + 0.5, 1, up));
      draft.faces.insert(draft.faces.end(), {{a, m, n}, {a, n, d}, {m, b, c}, {m, c, n}});
    }
  }
  const auto d = exact_distances(finish(draft), std::vector<Index>{0});
  for (Index v = 0; v < 2 * (2 * kLenses + 1); ++v) {
    EXPECT_NEAR(d[v], draft.positions[v].norm(), kRoundOff * kLenses) << v;
  }
}

TEST(ExactOnEveryTriangleOfAGridOfPoints, Ends) {
  // All edges have many faces: nothing is left of what other methods call a surface.
  Draft draft;
  for (int i = 0; i < 27; ++i) draft.add(Vec3(i % 3, i / 3 % 3, i / 9));
  for (Index a = 0; a < 27; ++a) {
    for (Index b = a + 1; b < 27; ++b) {
      for (Index c = b + 1; c < 27; ++c) {
        const Vec3 u = draft.positions[b] - draft.positions[a];
        const Vec3 v = draft.positions[c] - draft.positions[a];
        const bool small = u.norm() < 1.5 && v.norm() < 1.5 && (u - v).norm() < 1.5;
        if (small && u.cross(v).norm() > 0.1) draft.faces.push_back({a, b, c});
      }
    }
  }
  const auto d = exact_distances(finish(draft), std::vector<Index>{0});
  for (std::size_t v = 0; v < d.size(); ++v) {
    EXPECT_GE(d[v], draft.positions[v].norm() * (1 - kRoundOff));
    EXPECT_LE(d[v], draft.positions[v].lpNorm<1>() * (1 + kRoundOff));
  }
}

}  // namespace
}  // namespace geotherm::test
