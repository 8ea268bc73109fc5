// SPDX-License-Identifier: MIT
#include "solver/core/thread_crew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "solver/core/parallel.h"
#include "tests/support/no_threads.h"

namespace geotherm::test {
namespace {

/// The threads on which passes of so many pieces run.
std::set<std::thread::id> threads_of_passes(int passes, int pieces) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  for (int pass = 0; pass < passes; ++pass) {
    parallel_for(pieces, pieces, 1, [&](std::int64_t, std::int64_t) {
      const std::lock_guard lock(mutex);
      ids.insert(std::this_thread::get_id());
    });
  }
  return ids;
}

TEST(ThreadCrew, ServesOnePassAfterAnother) {
  ThreadCrew crew(3);
  const auto ids = threads_of_passes(50, 3);
  EXPECT_EQ(ids.size(), 3U);  // new threads might have old names, but not all fifty times
  EXPECT_EQ(threads_of_passes(50, 3), ids);
  EXPECT_TRUE(ids.contains(std::this_thread::get_id()));
}

TEST(ThreadCrew, VisitsEveryPieceOnceWhateverTheirNumber) {
  ThreadCrew crew(3);
  for (const int pieces : {2, 3, 9}) {
    std::vector<std::atomic<int>> visits(1000);
    for (int pass = 0; pass < 20; ++pass) {
      parallel_for(pieces, 1000, 1, [&](std::int64_t begin, std::int64_t end) {
        for (; begin < end; ++begin) ++visits[static_cast<std::size_t>(begin)];
      });
    }
    for (const auto& visit : visits) ASSERT_EQ(visit, 20);
  }
}

TEST(ThreadCrew, WakesFromItsSleep) {
  ThreadCrew crew(2);
  const auto ids = threads_of_passes(1, 2);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // hundreds of times its patience
  EXPECT_EQ(threads_of_passes(1, 2), ids);
}

TEST(ThreadCrew, LeavesAPassWithinAPassToOtherThreads) {
  ThreadCrew crew(2);
  std::atomic<int> visits = 0;
  parallel_for(2, 2, 1, [&](std::int64_t, std::int64_t) {
    parallel_for(2, 100, 1, [&](std::int64_t begin, std::int64_t end) {
      visits += static_cast<int>(end - begin);
    });
  });
  EXPECT_EQ(visits, 200);
}

TEST(ThreadCrew, OutlivesFailures) {
  ThreadCrew crew(2);
  for (int pass = 0; pass < 3; ++pass) {
    EXPECT_THROW(
        parallel_for(2, 100, 1,
                     [](std::int64_t, std::int64_t) { throw std::runtime_error("piece"); }),
        std::runtime_error);
  }
  EXPECT_EQ(threads_of_passes(1, 2).size(), 2U);
}

TEST(ThreadCrew, WithoutHelpersIsTheCaller) {
  const NoThreads none;
  if (!none.works()) GTEST_SKIP() << "threads start here whatever their stacks";
  ThreadCrew crew(3);
  EXPECT_EQ(threads_of_passes(2, 3), std::set{std::this_thread::get_id()});
}

TEST(ThreadCrew, GrowsWithItsPasses) {
  ThreadCrew crew(4);
  const auto two = threads_of_passes(3, 2);
  const auto four = threads_of_passes(3, 4);
  EXPECT_EQ(two.size(), 2U);
  EXPECT_EQ(four.size(), 4U);
  EXPECT_EQ(threads_of_passes(3, 2), two);
  for (const std::thread::id id : two) EXPECT_TRUE(four.contains(id));
}

TEST(ThreadCrew, ServesTheThreadThatMadeItAlone) {
  ThreadCrew crew(2);
  const auto ids = threads_of_passes(5, 2);
  std::set<std::thread::id> others;
  std::jthread([&] { others = threads_of_passes(1, 2); }).join();
  for (const std::thread::id id : others) EXPECT_FALSE(ids.contains(id));
}

TEST(ThreadCrew, EndsWithAnInnerOneInItsPlace) {
  ThreadCrew outer(2);
  const auto ids = threads_of_passes(1, 2);
  {
    ThreadCrew inner(2);
    EXPECT_NE(threads_of_passes(1, 2), ids);
  }
  EXPECT_EQ(threads_of_passes(1, 2), ids);
}

}  // namespace
}  // namespace geotherm::test
