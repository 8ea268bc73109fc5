// SPDX-License-Identifier: MIT
#include "solver/linear/symmetric_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/support/mesh_zoo.h"

namespace geotherm::test {
namespace {

class Patterns : public testing::TestWithParam<ZooMesh> {
 protected:
  MeshPtr mesh = GetParam().mesh();
  SymmetricPattern pattern = pattern_of_faces(
      mesh->vertex_count(), std::vector<Face>(mesh->faces().begin(), mesh->faces().end()));
};

TEST_P(Patterns, JoinVerticesThatShareAFace) {
  std::vector<std::set<Index>> expected(static_cast<std::size_t>(mesh->vertex_count()));
  for (const auto& [a, b, c] : mesh->faces()) {
    for (const auto& [i, j] : {std::pair{a, b}, {b, c}, {c, a}}) {
      if (i == j) continue;
      expected[i].insert(j);
      expected[j].insert(i);
    }
  }
  ASSERT_EQ(pattern.size(), mesh->vertex_count());
  for (Index i = 0; i < pattern.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(pattern.neighbors(i), expected[i])) << "vertex " << i;
  }
}

TEST_P(Patterns, ComponentsAreWhatNeighboursCanReach) {
  const Components parts = connected_components(pattern);
  std::set<Index> numbers(parts.of.begin(), parts.of.end());
  EXPECT_EQ(static_cast<Index>(numbers.size()), parts.count);
  for (Index i = 0; i < pattern.size(); ++i) {
    for (const Index j : pattern.neighbors(i)) EXPECT_EQ(parts.of[i], parts.of[j]);
  }
  const bool connected = (GetParam().tags & kConnected) != 0U;
  EXPECT_TRUE(!connected || parts.count == 1);
}

TEST_P(Patterns, RenamedTwiceIsThePatternAgain) {
  std::vector<Index> order(static_cast<std::size_t>(pattern.size()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Index>(k);
  std::mt19937 random(9);
  std::shuffle(order.begin(), order.end(), random);
  const SymmetricPattern renamed = permuted(pattern, order);
  for (Index k = 0; k < pattern.size(); ++k) {
    EXPECT_EQ(renamed.neighbors(k).size(), pattern.neighbors(order[k]).size());
  }
  const SymmetricPattern again = permuted(renamed, inverse_permutation(order));
  EXPECT_EQ(again.start, pattern.start);
  EXPECT_EQ(again.neighbor, pattern.neighbor);
  EXPECT_EQ(pattern_hash(again), pattern_hash(pattern));
}

TEST_P(Patterns, TheLowerTriangleIsThatOfTheRenamedPatternAndHasItsHash) {
  std::vector<Index> order(static_cast<std::size_t>(pattern.size()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Index>(k);
  std::mt19937 random(7);
  std::shuffle(order.begin(), order.end(), random);
  const SymmetricPattern renamed = permuted(pattern, order);
  const LowerPattern lower = permuted_lower(pattern, order);
  ASSERT_EQ(lower.start.size(), renamed.start.size());
  for (Index j = 0; j < renamed.size(); ++j) {
    std::vector<Index> expected = {j};
    for (const Index i : renamed.neighbors(j)) {
      if (i > j) expected.push_back(i);
    }
    EXPECT_EQ(std::vector<Index>(lower.row.begin() + lower.start[j],
                                 lower.row.begin() + lower.start[j + 1]),
              expected);
  }
  EXPECT_EQ(pattern_hash(lower), pattern_hash(renamed));
}

INSTANTIATE_TEST_SUITE_P(Zoo, Patterns, testing::ValuesIn(zoo()), zoo_name);

SymmetricPattern pattern_of(const Draft& draft) {
  return pattern_of_faces(draft.vertex_count(), draft.faces);
}

TEST(PatternHash, SeesOneFlippedEdge) {
  const Draft draft = plane_grid(30, 30, 1, 1);
  Draft flipped = draft;
  const auto [a, b, c] = draft.faces[400];
  const Index d = draft.faces[401][2];
  flipped.faces[400] = {a, b, d};
  flipped.faces[401] = {b, c, d};
  EXPECT_NE(pattern_hash(pattern_of(flipped)), pattern_hash(pattern_of(draft)));
}

TEST(PatternHash, SeesAnUnusedVertex) {
  const Draft draft = sphere(1);
  EXPECT_NE(pattern_hash(pattern_of_faces(draft.vertex_count() + 1, draft.faces)),
            pattern_hash(pattern_of(draft)));
}

TEST(PatternHash, DoesNotSeeTheOrderOfFaces) {
  Draft draft = sphere(1);
  const std::uint64_t hash = pattern_hash(pattern_of(draft));
  std::swap(draft.faces[3], draft.faces[50]);
  EXPECT_EQ(pattern_hash(pattern_of(draft)), hash);
}

}  // namespace
}  // namespace geotherm::test
