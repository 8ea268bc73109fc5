// SPDX-License-Identifier: MIT
#include "bench/benches.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bench/bench_fixture.h"

namespace geotherm::test {
namespace {

using bench::Growth;
using bench::measure_growth;
using bench::SolveGroup;

constexpr double kRoundOff = 1e-9;

TEST(Growth, IsTheExponentOfAPowerWhateverEachMeshsOwnPace) {
  std::vector<SolveGroup> groups;
  double pace = 1;
  for (const char* mesh : {"a", "b", "c"}) {
    pace *= 7;  // an offset of its own
    for (const Index faces : {10'000, 40'000, 90'000}) {
      groups.push_back(group_of(mesh, faces, mesh[0] == 'a'));
      groups.back().figures.push_back(figures_of("x", faces, pace, 1.3));
    }
  }
  const std::vector<Growth> growth = measure_growth(groups);
  ASSERT_EQ(growth.size(), 1u);
  EXPECT_NEAR(growth[0].all.setup, 1.3, kRoundOff);
  EXPECT_NEAR(growth[0].all.query, 1.0, kRoundOff);
}

TEST(Growth, OfRegularAndIrregularMeshesIsToldApart) {
  std::vector<SolveGroup> groups;
  for (const Index faces : {10'000, 100'000}) {
    groups.push_back(group_of("a", faces, true));
    groups.back().figures.push_back(figures_of("x", faces, 1, 1.1));
    groups.push_back(group_of("b", faces, false));
    groups.back().figures.push_back(figures_of("x", faces, 1, 1.5));
  }
  const std::vector<Growth> growth = measure_growth(groups);
  ASSERT_EQ(growth.size(), 1u);
  EXPECT_NEAR(growth[0].regular.setup, 1.1, kRoundOff);
  EXPECT_NEAR(growth[0].irregular.setup, 1.5, kRoundOff);
  EXPECT_NEAR(growth[0].all.setup, 1.3, kRoundOff);
}

TEST(Growth, IsNotSaidWithoutTwoSizesOfOneKind) {
  std::vector<SolveGroup> groups = {group_of("a", 10'000, true), group_of("b", 90'000, true),
                                    group_of("a", 90'000, true)};
  groups[0].figures.push_back(figures_of("x", 10'000, 1, 1.1));
  groups[1].figures.push_back(figures_of("x", 90'000, 1, 1.1));
  groups[2].figures.push_back({.name = "x"});
  groups[2].figures.back().not_run = "not run";
  EXPECT_TRUE(measure_growth(groups).empty());
}

TEST(Growth, LeavesFailedFiguresOut) {
  std::vector<SolveGroup> groups;
  for (const Index faces : {10'000, 40'000, 160'000}) {
    groups.push_back(group_of("a", faces, true));
    groups.back().figures.push_back(figures_of("x", faces, 1, 1.2));
  }
  groups.back().figures.back().setup_ms *= 1000;
  groups.back().figures.back().failure = "failed";
  const std::vector<Growth> growth = measure_growth(groups);
  ASSERT_EQ(growth.size(), 1u);
  EXPECT_NEAR(growth[0].all.setup, 1.2, kRoundOff);
}

}  // namespace
}  // namespace geotherm::test
