// SPDX-License-Identifier: MIT
#include "geotherm/progress.h"
#include "solver/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace geotherm::test {
namespace {

TEST(Progress, OfAPartIsAShareOfTheWhole) {
  std::vector<double> shares;
  const Progress whole = [&shares](std::string_view, double share) {
    shares.push_back(share);
    return share < 0.7;
  };
  const Progress half = part_of(part_of(whole, 0.5, 1), 0, 0.5);
  EXPECT_TRUE(report(half, "a", 0));
  EXPECT_TRUE(report(half, "a", 0.5));
  EXPECT_TRUE(report(half, "a", -1));
  EXPECT_FALSE(report(half, "a", 1));
  EXPECT_EQ(shares, (std::vector<double>{0.5, 0.625, -1, 0.75}));
  EXPECT_TRUE(report(part_of({}, 0, 1), "a", 1));
}

TEST(Progress, OfThreadsIsCalledByOneAtATimeInOrderAndNotAgainAfterStop) {
  constexpr int kMax = 500;
  std::atomic<int> inside = 0;
  int calls = 0;
  double last = 0;
  const Progress progress = [&](std::string_view, double share) {
    EXPECT_EQ(++inside, 1);
    EXPECT_GE(share, last);
    last = share;
    --inside;
    return ++calls < kMax;
  };
  SharedProgress shared(progress);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 3; ++t) {
      threads.emplace_back([&shared] {
        const Progress mine = shared.function();
        for (int i = 0; i < 1000; ++i) report(mine, "a", i / 1000.0);
      });
    }
  }
  EXPECT_EQ(calls, kMax);
  EXPECT_FALSE(report(shared.function(), "a", 1));
}

TEST(Progress, OfThreadsKeepsAnExceptionForTheEnd) {
  int calls = 0;
  const Progress progress = [&](std::string_view, double) -> bool {
    ++calls;
    throw std::runtime_error("from the progress");
  };
  SharedProgress shared(progress);
  EXPECT_FALSE(report(shared.function(), "a", 0));
  EXPECT_FALSE(report(shared.function(), "a", 1));
  EXPECT_EQ(calls, 1);
  EXPECT_THROW(shared.rethrow(), std::runtime_error);
  EXPECT_NO_THROW(shared.rethrow()) << "it was thrown";
}

TEST(Progress, OfThreadsCanBeStoppedFromWithin) {
  const Progress nobody;
  SharedProgress shared(nobody);
  EXPECT_TRUE(report(shared.function(), "a", 0));
  shared.stop();
  EXPECT_FALSE(report(shared.function(), "a", 0));
}

}  // namespace
}  // namespace geotherm::test
