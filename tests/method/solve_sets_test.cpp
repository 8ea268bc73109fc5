// SPDX-License-Identifier: MIT
#include "solver/method/solve_sets.h"

#include <gtest/gtest.h>

#include <new>
#include <string>

#include "tests/support/no_threads.h"

namespace geotherm::test {
namespace {

constexpr std::size_t kSets = 9;
constexpr double kLong = 1e9;  // nanoseconds: worth as many threads as there are sets

std::vector<SourceSet> some_sets() {
  std::vector<SourceSet> sets;
  for (std::size_t i = 0; i < kSets; ++i) {
    sets.push_back(SourceSet::of_vertices({static_cast<Index>(i)}));
  }
  return sets;
}

/// An answer from which its set can be told.
Result<DistanceResult> name_of(const SourceSet& set, const Progress&) {
  DistanceResult result;
  result.distances = {static_cast<double>(set.points[0].vertex)};
  return result;
}

void expect_all(const Result<std::vector<DistanceResult>>& results) {
  ASSERT_TRUE(results) << results.error().message;
  ASSERT_EQ(results->size(), kSets);
  for (std::size_t i = 0; i < kSets; ++i) {
    EXPECT_EQ((*results)[i].distances, std::vector<double>{static_cast<double>(i)});
  }
}

TEST(SolveSetsThreads, AnswerInTheOrderOfTheSets) {
  for (const int threads : {1, 2, 20})
    expect_all(solve_sets(some_sets(), {threads, kLong}, {}, name_of));
}

TEST(SolveSets, NeedsNoThreadBesideTheCallers) {
  const NoThreads none;
  if (!none.works()) GTEST_SKIP() << "threads start here whatever their stacks";
  expect_all(solve_sets(some_sets(), {4, kLong}, {}, name_of));
}

TEST(SolveSetsThreads, TurnTheEndOfMemoryIntoAnError) {
  for (const int threads : {1, 3}) {
    const auto result =
        solve_sets(some_sets(), {threads, kLong}, {},
                   [](const SourceSet& set, const Progress& progress) -> Result<DistanceResult> {
                     if (set.points[0].vertex == 4) throw std::bad_alloc();
                     return name_of(set, progress);
                   });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kOutOfMemory);
    EXPECT_NE(sentence(result.error()).find("fewer faces"), std::string::npos);
  }
}

TEST(SolveSetsThreads, AreNoMoreThanSetsAndAtLeastOne) {
  EXPECT_EQ((SetThreads{4, kLong}.at_once(2)), 2);
  EXPECT_EQ((SetThreads{4, kLong}.at_once(9)), 4);
  EXPECT_EQ((SetThreads{4, kLong}.at_once(0)), 1);
  EXPECT_GE((SetThreads{0, kLong}.at_once(2)), 1);
}

TEST(SolveSetsThreads, AreNoMoreThanThereIsWorkFor) {
  constexpr double kMicrosecond = 1e3, kMillisecond = 1e6;
  EXPECT_EQ((SetThreads{4, kMicrosecond}.at_once(100)), 1);
  EXPECT_EQ((SetThreads{4, kMillisecond}.at_once(4)), 2);
  EXPECT_EQ((SetThreads{4, kMillisecond}.at_once(100)), 4);
}

}  // namespace
}  // namespace geotherm::test
