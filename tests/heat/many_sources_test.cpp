// SPDX-License-Identifier: MIT
// With many sources most faces touch one, and the straight distances there make up the answer: they
// must not depend on the order in which faces are visited, which backends and numberings choose.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "tests/support/solve.h"

namespace geotherm::test {
namespace {

// The tolerance is a share of the largest distance: what is promised.
constexpr double kDirect = 1e-9;
constexpr double kIterative = 1e-6;

std::vector<Index> random_vertices(Index count, Index vertex_count) {
  std::mt19937 random(17);
  std::vector<Index> all(static_cast<std::size_t>(vertex_count));
  for (Index v = 0; v < vertex_count; ++v) all[v] = v;
  std::shuffle(all.begin(), all.end(), random);
  all.resize(static_cast<std::size_t>(count));
  return all;
}

using ManyCase = std::tuple<std::string, Index>;

class ManySources : public testing::TestWithParam<ManyCase> {
 protected:
  // Edges of very different lengths: a way round along two edges may be shorter than one.
  Draft draft = jittered_plane(44, 0.45, 5);
  std::string backend = std::get<0>(GetParam());
  std::vector<Index> sources = random_vertices(std::get<1>(GetParam()), draft.vertex_count());
  double promised = (*find_backend(backend))->iterative() ? kIterative : kDirect;
};

TEST_P(ManySources, GiveTheSameDistancesWithEveryBackend) {
  const auto reference =
      solve(finish(draft), sources, with_backend(direct_backends().front())).distances;
  EXPECT_LE(relative_difference(solve(finish(draft), sources, with_backend(backend)).distances,
                                reference),
            promised);
}

TEST_P(ManySources, GiveTheSameDistancesInEveryNumbering) {
  const auto reference = solve(finish(draft), sources, with_backend(backend)).distances;
  std::vector<Index> number;
  const Draft other = renumbered(draft, 8, number);
  std::vector<Index> renamed;
  for (const Index s : sources) renamed.push_back(number[s]);
  const auto d = solve(finish(other), renamed, with_backend(backend)).distances;
  std::vector<double> back(d.size());
  for (std::size_t v = 0; v < d.size(); ++v) back[v] = d[number[v]];
  EXPECT_LE(relative_difference(back, reference), promised);
}

// A neighbour of a source lies no farther from it than their edge is long, twice its way at most
// where a flip took the edge away.
TEST_P(ManySources, AreReachedByTheirNeighbours) {
  const auto d = solve(finish(draft), sources, with_backend(backend)).distances;
  std::vector<char> is_source(d.size(), 0);
  for (const Index s : sources) is_source[s] = 1;
  for (const Face& face : draft.faces) {
    for (int k = 0; k < 3; ++k) {
      const Index a = face[k], b = face[(k + 1) % 3];
      if (!is_source[a] || is_source[b]) continue;
      EXPECT_LE(d[b], 2 * (draft.positions[a] - draft.positions[b]).norm()) << "vertex " << b;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, ManySources,
                         testing::Combine(testing::ValuesIn(backend_names()),
                                          testing::Values(100, 1000)),
                         [](const auto& each) {
                           return test_name(std::get<0>(each.param)) + "_" +
                                  std::to_string(std::get<1>(each.param));
                         });

// Pinned sources are moved to 0 at the end: what the solve itself gave there must be reported.
TEST(ManySourcesAtOnce, HaveARawDistanceOfRoundOff) {
  const MeshPtr mesh = finish(jittered_plane(24, 0.3, 5));
  for (const std::string& backend : direct_backends()) {
    const auto result =
        solve(mesh, random_vertices(20, mesh->vertex_count()), with_backend(backend));
    EXPECT_GT(result.quality.max_source_distance, 0) << backend;
    EXPECT_LE(result.quality.max_source_distance, kDirect * largest(result.distances)) << backend;
  }
}

}  // namespace
}  // namespace geotherm::test
