// SPDX-License-Identifier: MIT
#include "solver/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/no_threads.h"

namespace geotherm::test {
namespace {

class ParallelFor : public testing::TestWithParam<int> {};

TEST_P(ParallelFor, VisitsEveryIndexOnce) {
  for (const std::int64_t count : {0, 1, 7, 64, 1000}) {
    for (const std::int64_t grain : {1, 10, 5000}) {
      std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
      parallel_for(GetParam(), count, grain, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      for (const auto& visit : visits) EXPECT_EQ(visit, 1);
    }
  }
}

TEST_P(ParallelFor, ListsStandInTheOrderOfTheirBlocks) {
  for (const std::int64_t count : {0, 1, 64, 1000}) {
    const auto odd = list_in_parallel<std::int64_t>(
        GetParam(), count, 10, [](std::int64_t begin, std::int64_t end, auto& list) {
          for (std::int64_t i = begin; i < end; ++i) {
            if (i % 2 == 1) list.push_back(i);
          }
        });
    ASSERT_EQ(std::ssize(odd), count / 2);
    for (std::int64_t i = 0; i < count / 2; ++i)
      EXPECT_EQ(odd[static_cast<std::size_t>(i)], 2 * i + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(1, 2, 5));

TEST_P(ParallelFor, BothFunctionsRunAndFailuresReachTheCaller) {
  int first = 0, second = 0;
  run_both(
      GetParam(), [&] { first = 1; }, [&] { second = 2; });
  EXPECT_EQ(first + second, 3);
  EXPECT_THROW(run_both(
                   GetParam(), [] { throw std::runtime_error("first"); }, [] {}),
               std::runtime_error);
  EXPECT_THROW(run_both(
                   GetParam(), [] {}, [] { throw std::runtime_error("second"); }),
               std::runtime_error);
}

TEST_P(ParallelFor, FailuresReachTheCallerAfterAllPiecesHaveEnded) {
  std::atomic<int> visits = 0;
  const auto work = [&](std::int64_t begin, std::int64_t end) {
    visits += static_cast<int>(end - begin);
    throw std::runtime_error("from " + std::to_string(begin));
  };
  try {
    parallel_for(GetParam(), 100, 1, work);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& failure) {
    EXPECT_STREQ(failure.what(), "from 0");
  }
  EXPECT_EQ(visits, 100);
}

TEST_P(ParallelFor, SumsHaveTheBitsOfOneThread) {
  const auto part = [](std::int64_t begin, std::int64_t end) {
    double sum = 0;
    for (std::int64_t i = begin; i < end; ++i) sum += 1.0 / static_cast<double>(i + 1);
    return sum;
  };
  for (const std::int64_t count : {0, 1, 8192, 300'000}) {
    EXPECT_EQ(parallel_sum(GetParam(), count, part), parallel_sum(1, count, part));
    EXPECT_NEAR(parallel_sum(GetParam(), count, part), part(0, count), 1e-12);
  }
}

TEST(WorkWithoutThreads, IsDoneByTheCaller) {
  const NoThreads none;
  if (!none.works()) GTEST_SKIP() << "threads start here whatever their stacks";
  EXPECT_FALSE(try_thread([] {}).joinable());
  std::vector<int> visits(100);
  parallel_for(4, 100, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
  });
  EXPECT_EQ(visits, std::vector<int>(100, 1));
  int first = 0, second = 0;
  run_both(
      2, [&] { ++first; }, [&] { ++second; });
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
}

TEST(ThreadCount, OfZeroMeansAllCores) {
  EXPECT_EQ(thread_count(3), 3);
  EXPECT_GE(thread_count(0), 1);
  EXPECT_EQ(thread_count(-2), thread_count(0));
}

}  // namespace
}  // namespace geotherm::test
