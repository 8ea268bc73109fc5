// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "solver/core/sorting.h"

namespace geotherm::test {
namespace {

TEST(ShortSort, SortsListsOfAnyLengthWithEqualEntries) {
  std::mt19937 random(1);
  for (std::size_t length = 0; length < 40; ++length) {
    for (const Index most : {3, 1000, kLastKey - 1}) {
      std::uniform_int_distribution<Index> number(0, most);
      std::vector<Index> list(length);
      for (Index& entry : list) entry = number(random);
      std::vector<Index> expected = list;
      std::ranges::sort(expected);
      short_sort(list.data(), list.data() + list.size());
      EXPECT_EQ(list, expected) << length << " numbers up to " << most;
    }
  }
}

class SortByThreads : public testing::TestWithParam<int> {};

TEST_P(SortByThreads, GroupsByKeyAndKeepsTheOrderInEach) {
  constexpr std::size_t kItems = 200'000, kKeys = 777;  // a part for each of seven threads
  const auto key = [](std::size_t i) { return static_cast<Index>(i * i % kKeys); };
  std::vector<Index> expected(kItems);
  for (std::size_t i = 0; i < kItems; ++i) expected[i] = static_cast<Index>(i);
  std::ranges::stable_sort(expected, {}, [&](Index i) { return key(static_cast<std::size_t>(i)); });
  const auto sorted = sorted_by_key(kItems, kKeys, GetParam(), key);
  EXPECT_TRUE(std::ranges::equal(sorted, expected));
}

TEST_P(SortByThreads, PutsRowsOfUnknownLengthTogether) {
  constexpr Index kRows = 100'000;
  const auto add_row = [](Index i, std::vector<Index>& list) { list.insert(list.end(), i % 4, i); };
  std::vector<std::int64_t> start;
  std::vector<Index> list;
  list_rows(kRows, GetParam(), add_row, start, list);
  ASSERT_EQ(start.size(), static_cast<std::size_t>(kRows) + 1);
  ASSERT_EQ(start.back(), static_cast<std::int64_t>(list.size()));
  for (Index i = 0; i < kRows; ++i) {
    ASSERT_EQ(start[i + 1] - start[i], i % 4);
    for (auto e = start[i]; e < start[i + 1]; ++e) ASSERT_EQ(list[e], i);
  }
}

TEST(FindBytes, GoesThroughAllOfAValueAlsoThoseItChanges) {
  std::vector<char> bytes = {1, 0, 1, 1, 2, 0, 1};
  std::vector<Index> found;
  for_each_with_value(bytes, char{1}, [&](Index i) {
    found.push_back(i);
    bytes[i] = 0;
  });
  EXPECT_EQ(found, (std::vector<Index>{0, 2, 3, 6}));
  for_each_with_value(std::vector<char>(), char{1}, [](Index) { FAIL(); });
}

TEST(DisjointSets, AreCalledByTheirLowestMembers) {
  DisjointSets sets(7);
  for (const auto& [a, b] : {std::pair(6, 3), std::pair(3, 5), std::pair(4, 1)}) sets.join(a, b);
  EXPECT_EQ(sets.root(6), 3);
  EXPECT_EQ(std::move(sets).roots(), (std::vector<Index>{0, 1, 2, 3, 1, 3, 3}));
}

INSTANTIATE_TEST_SUITE_P(Threads, SortByThreads, testing::Values(1, 2, 3, 7));

}  // namespace
}  // namespace geotherm::test
