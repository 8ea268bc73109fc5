// SPDX-License-Identifier: MIT
#include "solver/linear/multifrontal/fill_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "solver/linear/elimination_tree.h"
#include "tests/support/mesh_zoo.h"
#include "tests/support/operators.h"
#include "tests/support/sanitized.h"

namespace geotherm::test {
namespace {

// Dissection stores 1.5 % less than minimum degree on the grid of the test, and as much where its
// leaves do not count their halo.
constexpr double kFill = 0.99;

/// Entries of the Cholesky factor, by elimination on sets of neighbours (Rose 1972).
std::int64_t fill_of(const SymmetricPattern& pattern, const std::vector<Index>& order) {
  const SymmetricPattern ordered = permuted(pattern, order);
  std::vector<std::set<Index>> above(order.size());
  for (Index i = 0; i < ordered.size(); ++i) {
    for (const Index j : ordered.neighbors(i)) {
      if (j > i) above[i].insert(j);
    }
  }
  std::int64_t entries = 0;
  for (auto& neighbors : above) {
    entries += 1 + static_cast<std::int64_t>(neighbors.size());
    if (neighbors.empty()) continue;
    const Index parent = *neighbors.begin();
    above[parent].insert(std::next(neighbors.begin()), neighbors.end());
  }
  return entries;
}

bool is_permutation_of_all(std::vector<Index> order, Index n) {
  std::sort(order.begin(), order.end());
  std::vector<Index> expected(static_cast<std::size_t>(n));
  std::iota(expected.begin(), expected.end(), 0);
  return order == expected;
}

struct Graph {
  SymmetricPattern pattern;
  std::vector<Vec3> positions;
};
Graph graph_of(const TriangleMesh& mesh) {
  const Intrinsic in = intrinsic_of(mesh, false);
  const Numbering numbers = numbering_of(mesh, in.clean);
  Graph out{pattern_of(in.mesh, numbers), {}};
  for (const Index v : numbers.vertex) out.positions.push_back(mesh.positions()[v]);
  return out;
}

class NestedDissection : public testing::TestWithParam<ZooMesh> {
 protected:
  Graph graph = graph_of(*GetParam().mesh());
};

TEST_P(NestedDissection, IsAPermutationAndTheSameInParallel) {
  const auto order = nested_dissection(graph.pattern, graph.positions, 1);
  EXPECT_TRUE(is_permutation_of_all(order, graph.pattern.size()));
  EXPECT_EQ(nested_dissection(graph.pattern, graph.positions, 4), order);
}

TEST_P(NestedDissection, ManagesPointsThatAllCoincide) {
  const std::vector<Vec3> nowhere(graph.positions.size(), Vec3(1, 2, 3));
  EXPECT_TRUE(
      is_permutation_of_all(nested_dissection(graph.pattern, nowhere, 1), graph.pattern.size()));
}

INSTANTIATE_TEST_SUITE_P(Zoo, NestedDissection, testing::ValuesIn(zoo()), zoo_name);

TEST(FillOrder, OfDissectionIsLessThanThatOfMinimumDegree) {
  const Graph graph = graph_of(*finish(plane_grid(70, 70, 1, 1)));
  const auto dissected = nested_dissection(graph.pattern, graph.positions, 1);
  const auto by_degree = fill_reducing_order(graph.pattern, {}, 1);
  EXPECT_TRUE(is_permutation_of_all(by_degree, graph.pattern.size()));
  EXPECT_LE(static_cast<double>(fill_of(graph.pattern, dissected)),
            kFill * static_cast<double>(fill_of(graph.pattern, by_degree)));
}

/// A pipe of rings of 1500 vertices, a hundred times as high as wide: planes across it cut nothing,
/// and those along it four edges a ring.
TriangleMesh pipe(Index rings) {
  constexpr Index kAround = 1500;
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (Index r = 0; r < rings; ++r) {
    for (Index i = 0; i < kAround; ++i) {
      const double angle = 2 * M_PI * i / kAround;
      positions.emplace_back(std::cos(angle), std::sin(angle), 200.0 * r / (rings - 1));
      if (r == 0) continue;
      const Index a = r * kAround + i, b = r * kAround + (i + 1) % kAround;
      faces.push_back({a - kAround, b - kAround, b});
      faces.push_back({a - kAround, b, a});
    }
  }
  return *TriangleMesh::build(std::move(positions), std::move(faces));
}

TEST(FillOrder, OfANeedleIsThatOfItsShortCuts) {
  constexpr double kTwice = 2;  // minimum degree is close to the best on a band
  for (const Index rings : {2, 3, 4}) {
    const Graph graph = graph_of(pipe(rings));
    const auto dissected = nested_dissection(graph.pattern, graph.positions, 1);
    EXPECT_TRUE(is_permutation_of_all(dissected, graph.pattern.size()));
    const auto by_degree = fill_reducing_order(graph.pattern, {}, 1);
    EXPECT_LE(static_cast<double>(fill_of(graph.pattern, dissected)),
              kTwice * static_cast<double>(fill_of(graph.pattern, by_degree)))
        << rings;
  }
}

TEST(FillOrder, OfALargeMeshIsTheSameWithAnyNumberOfThreads) {
  // Large enough for every pass over vertices to be divided.
  const Graph graph = graph_of(*finish(jittered_plane(kSanitized ? 202 : 220, 0.35, 3)));
  const auto order = nested_dissection(graph.pattern, graph.positions, 1);
  for (const int threads : kSanitized ? std::vector{7} : std::vector{2, 7}) {
    EXPECT_EQ(nested_dissection(graph.pattern, graph.positions, threads), order) << threads;
  }
}

TEST(FillOrder, DoesNotDependOnScaleOrPlace) {
  const Graph graph = graph_of(*finish(torus(80, 40, 0.4)));
  std::vector<Vec3> moved = graph.positions;
  for (Vec3& p : moved) p = 1024 * p;  // a power of two: no rounding
  EXPECT_EQ(nested_dissection(graph.pattern, moved, 1),
            nested_dissection(graph.pattern, graph.positions, 1));
}

TEST(MinimumDegree, LeavesTheCentreOfAStarForTheEnd) {
  constexpr std::size_t kLeaves = kSmallGraph - 1;
  std::vector<NeighborMask> star(kSmallGraph, NeighborMask{1, 0});
  star[0] = {~1ULL, 0};
  std::vector<Index> order(kSmallGraph);
  minimum_degree_order(star, order);
  EXPECT_TRUE(is_permutation_of_all(order, kSmallGraph));
  // With one leaf left the centre has no higher degree than it.
  for (std::size_t k = 0; k + 1 < kLeaves; ++k) EXPECT_NE(order[k], 0);
}

TEST(MinimumDegree, CountsNeighboursInTheHalo) {
  // A path 0 - 1 - 2 - 3 whose ends touch four each of what is eliminated later: by the path alone
  // the ends would go first.
  std::vector<NeighborMask> path = {{0b0010, 0b1111}, {0b0101, 0}, {0b1010, 0}, {0b0100, 0xf0}};
  std::vector<Index> order(path.size());
  minimum_degree_order(path, order);
  EXPECT_EQ(order, (std::vector<Index>{1, 2, 0, 3}));
}

TEST(MinimumDegree, HandsTheHaloOfTheEliminatedOn) {
  // 0 goes first and leaves its one neighbour in the halo to 2, which then has three, as 1 has.
  std::vector<NeighborMask> graph = {{0b100, 0b1}, {0, 0b1110}, {0b001, 0b110000}};
  std::vector<Index> order(graph.size());
  minimum_degree_order(graph, order);
  EXPECT_EQ(order, (std::vector<Index>{0, 1, 2}));
}

TEST(EliminationPath, HoldsAllAncestorsOnce) {
  //     6        nodes 0..6 of one row each; 7 is a root of its own
  //   4   5
  //  0 1 2 3
  const EliminationTree tree{{4, 4, 5, 5, 6, 6, kNoIndex, kNoIndex}, {0, 1, 2, 3, 4, 5, 6, 7}};
  const auto path = [&tree](std::vector<Index> rows) { return tree.path(rows); };
  EXPECT_EQ(path({}), std::vector<Index>{});
  EXPECT_EQ(path({1}), (std::vector<Index>{1, 4, 6}));
  EXPECT_EQ(path({3, 0, 3}), (std::vector<Index>{0, 3, 4, 5, 6}));
  EXPECT_EQ(path({7, 6}), (std::vector<Index>{6, 7}));
}

TEST(EliminationPath, CountsASupernodeOnce) {
  const EliminationTree tree{{1, kNoIndex}, {0, 0, 1, 1, 1}};
  EXPECT_EQ(tree.path(std::vector<Index>{0, 1}), (std::vector<Index>{0, 1}));
}

}  // namespace
}  // namespace geotherm::test
