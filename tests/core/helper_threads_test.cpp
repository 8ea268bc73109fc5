// SPDX-License-Identifier: MIT
#include "solver/core/threads.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <semaphore.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <ctime>
#include <functional>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace geotherm::test {
namespace {

using std::chrono::milliseconds;

void run(HelperThreads& team, int calls, int helpers, const std::function<void(int)>& work) {
  const auto call = [](void* context, int k, HelperThreads&) {
    (*static_cast<const std::function<void(int)>*>(context))(k);
  };
  team.run(calls, helpers, const_cast<std::function<void(int)>*>(&work), call);
}

/// Waits up to half a minute.
bool comes_true(const std::function<bool()>& fact) {
  for (int k = 0; k < 30'000 && !fact(); ++k) std::this_thread::sleep_for(milliseconds(1));
  return fact();
}

/// The thread that helps in a pass in which it must.
pthread_t helper_of(HelperThreads& team) {
  pthread_t helper = pthread_self();
  std::atomic<bool> helped{false};
  run(team, 2, 1, [&](int k) {
    if (k == 0) {
      EXPECT_TRUE(comes_true([&] { return helped.load(); }));
    } else {
      helper = pthread_self();
      helped = true;
    }
  });
  EXPECT_FALSE(pthread_equal(helper, pthread_self()));
  return helper;
}

/// Keeps a thread from running, as a busy machine does: it waits in a signal's handler.
class Held {
 public:
  explicit Held(pthread_t thread) {
    sem_init(&there, 0, 0);
    sem_init(&goes_on, 0, 0);
    struct sigaction action {};
    action.sa_handler = [](int) {
      sem_post(&there);
      while (sem_wait(&goes_on) != 0) {
      }
    };
    sigaction(SIGUSR1, &action, &before_);
    pthread_kill(thread, SIGUSR1);
    while (sem_wait(&there) != 0) {
    }
  }
  ~Held() {
    sem_post(&goes_on);
    std::this_thread::sleep_for(milliseconds(1));
    sigaction(SIGUSR1, &before_, nullptr);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  static inline sem_t there, goes_on;
  struct sigaction before_ {};
};

double cpu_milliseconds(clockid_t clock) {
  timespec time{};
  EXPECT_EQ(clock_gettime(clock, &time), 0);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

TEST(HelperThreads, AreNotWaitedForWhereTheyDoNotRun) {
  HelperThreads team;
  const pthread_t helper = helper_of(team);
  const Held held(helper);
  std::set<std::thread::id> ids;
  std::vector<int> visits(100);
  run(team, 100, 1, [&](int k) {
    ++visits[static_cast<std::size_t>(k)];
    ids.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(visits, std::vector<int>(100, 1));
  EXPECT_EQ(ids, std::set{std::this_thread::get_id()});
}

TEST(HelperThreads, HoldUpNoMoreThanTheCallTheyAreIn) {
  HelperThreads team;
  const auto owner = std::this_thread::get_id();
  std::atomic<bool> helper_in{false};
  std::atomic<int> of_owner{0};
  bool rest_was_done = false;
  run(team, 20, 1, [&](int) {
    if (std::this_thread::get_id() != owner) {
      helper_in = true;
      rest_was_done = comes_true([&] { return of_owner == 19; });
      return;
    }
    if (of_owner == 0) {
      EXPECT_TRUE(comes_true([&] { return helper_in.load(); }));
    }
    ++of_owner;
  });
  EXPECT_TRUE(rest_was_done);
}

TEST(HelperThreads, SleepWhileThereIsNothingToDo) {
  constexpr milliseconds kWait(200);
  const double most = 0.2 * static_cast<double>(kWait.count());
  HelperThreads team;
  clockid_t of_helper{};
  ASSERT_EQ(pthread_getcpuclockid(helper_of(team), &of_helper), 0);
  const double helper_before = cpu_milliseconds(of_helper);
  std::this_thread::sleep_for(kWait);
  EXPECT_LT(cpu_milliseconds(of_helper) - helper_before, most);

  const auto owner = std::this_thread::get_id();
  std::atomic<bool> helper_in{false};
  const double owner_before = cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID);
  run(team, 2, 1, [&](int) {
    if (std::this_thread::get_id() == owner) {
      EXPECT_TRUE(comes_true([&] { return helper_in.load(); }));
    } else {
      helper_in = true;
      std::this_thread::sleep_for(kWait);
    }
  });
  EXPECT_LT(cpu_milliseconds(CLOCK_THREAD_CPUTIME_ID) - owner_before, most);
}

TEST(HelperThreads, CallOthersToMoreFromWithin) {
  HelperThreads team;
  struct Context {
    std::mutex mutex;
    std::vector<int> numbers;
  } context;
  // Each call below 50 has two more made: 2 + 2 * 50 in all.
  team.run(2, 2, &context, [](void* at, int k, HelperThreads& others) {
    auto& to = *static_cast<Context*>(at);
    {
      const std::lock_guard lock(to.mutex);
      to.numbers.push_back(k);
    }
    if (k < 50) others.call_more(2);
  });
  std::ranges::sort(context.numbers);
  std::vector<int> all(102);
  for (int k = 0; k < 102; ++k) all[static_cast<std::size_t>(k)] = k;
  EXPECT_EQ(context.numbers, all);
}

TEST(HelperThreads, EndWhereNobodyNeedsThemAndStartAgain) {
  HelperThreads team(milliseconds(5));
  helper_of(team);
  EXPECT_TRUE(comes_true([&] { return team.alive() == 0; }));
  helper_of(team);
}

}  // namespace
}  // namespace geotherm::test
