// SPDX-License-Identifier: MIT
#include "solver/core/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "solver/core/parallel.h"
#include "tests/support/no_threads.h"

namespace geotherm::test {
namespace {

/// The threads on which passes of so many calls run, each of which waits for the others.
std::set<std::thread::id> threads_of_passes(int passes, int calls) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  for (int pass = 0; pass < passes; ++pass) {
    std::barrier all_there(calls);
    run_calls(calls, calls, [&](int) {
      all_there.arrive_and_wait();
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
  std::set<std::thread::id> ids;
  run_calls(3, 30, [&](int) { ids.insert(std::this_thread::get_id()); });
  EXPECT_EQ(ids, std::set{std::this_thread::get_id()});
}

TEST(ThreadCrew, GrowsWithItsPasses) {
  ThreadCrew crew(4);
  const auto two = threads_of_passes(3, 2);
  const auto four = threads_of_passes(3, 4);
  EXPECT_EQ(two.size(), 2U);
  EXPECT_EQ(four.size(), 4U);
  for (const std::thread::id id : threads_of_passes(3, 2)) EXPECT_TRUE(four.contains(id));
  for (const std::thread::id id : two) EXPECT_TRUE(four.contains(id));
}

TEST(ThreadCrew, ServesTheThreadThatMadeItAlone) {
  ThreadCrew crew(2);
  const auto ids = threads_of_passes(5, 2);
  std::set<std::thread::id> others;
  std::jthread([&] { others = threads_of_passes(1, 2); }).join();
  for (const std::thread::id id : others) EXPECT_FALSE(ids.contains(id));
}

TEST(ThreadCrew, OfOneThreadKeepsPassesOnIt) {
  ThreadCrew outer(4);
  const ThreadCrew inner(1);
  std::set<std::thread::id> ids;
  run_calls(4, 100, [&](int) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));  // others had time to come
    ids.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(ids, std::set{std::this_thread::get_id()});
}

TEST(ThreadCrew, LeavesItsHelpersToTheNextThroughAPool) {
  HelperPool pool;
  std::set<std::thread::id> first;
  for (int crew_of_many = 0; crew_of_many < 10; ++crew_of_many) {
    const ThreadCrew crew(2, &pool);
    const auto ids = threads_of_passes(1, 2);
    if (crew_of_many == 0) first = ids;
    EXPECT_EQ(ids, first);
  }
  EXPECT_NE(pool.take(), nullptr);
  EXPECT_EQ(pool.take(), nullptr);
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
