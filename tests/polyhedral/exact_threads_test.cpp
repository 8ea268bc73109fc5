// SPDX-License-Identifier: MIT
#include <atomic>
#include <limits>

#include "tests/polyhedral/exact_fixture.h"

namespace geotherm::test {
namespace {

std::vector<SourceSet> some_sets(Index count) {
  std::vector<SourceSet> sets;
  for (Index k = 0; k < count; ++k) sets.push_back(SourceSet::of_vertices({11 * k, 7 * k + 2}));
  return sets;
}

TEST(ExactThreads, AnyNumberOfThemGivesTheSameBits) {
  const MeshPtr mesh = finish(torus(24, 12, 0.4));
  const auto sets = some_sets(9);
  const auto one = exact_method(mesh, 1)->solve_each(sets, {.nearest = true});
  const auto four = exact_method(mesh, 4)->solve_each(sets, {.nearest = true});
  ASSERT_TRUE(one && four);
  ASSERT_EQ(one->size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ((*one)[i].distances, (*four)[i].distances);
    EXPECT_EQ((*one)[i].nearest_source, (*four)[i].nearest_source);
  }
}

TEST(ExactThreads, AFailureOfOneSetIsTheAnswerWhicheverThreadMeetsIt) {
  auto sets = some_sets(6);
  sets[2] = SourceSet::of_vertices({1'000'000});
  const auto method = exact_method(finish(torus(24, 12, 0.4)), 3);
  const auto alone = method->solve(sets[2]);
  const auto result = method->solve_each(sets);
  ASSERT_FALSE(result || alone);
  EXPECT_EQ(sentence(result.error()), sentence(alone.error()));
}

TEST(ExactThreads, AskTheirProgressBeforeEverySetAsStageSolve) {
  const auto method = exact_method(finish(sphere(1)), 3);  // too small to ask in between
  const auto sets = some_sets(4);
  std::atomic<std::size_t> calls = 0;
  const auto result = method->solve_each(sets, {}, [&](std::string_view stage, double) {
    EXPECT_EQ(stage, "solve");
    ++calls;
    return true;
  });
  ASSERT_TRUE(result);
  EXPECT_GE(calls, sets.size());
}

TEST(ExactThreads, DoNotGoOnAfterAFailure) {
  auto sets = some_sets(6);
  sets[1] = {};
  const auto method = exact_method(finish(sphere(1)), 1);
  constexpr double kTwoSets = 2.0 / 6;
  EXPECT_FALSE(method->solve_each(sets, {}, [&](std::string_view, double share) {
    EXPECT_LE(share, kTwoSets);
    return true;
  }));
}

TEST(ExactThreads, AreStoppedByTheirProgress) {
  const auto method = exact_method(finish(sphere(5)), 2);
  std::atomic<int> calls = 0;
  const auto result = method->solve_each(some_sets(4), {}, [&](std::string_view, double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    return ++calls < 3;
  });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(calls, 3);
}

TEST(ExactThreads, NoSetsHaveNoAnswers) {
  const auto result = exact_method(finish(sphere(1)), 2)->solve_each({});
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->empty());
}

}  // namespace
}  // namespace geotherm::test
