// SPDX-License-Identifier: MIT
// The same distances, to the last bit, for any number of threads.
#include <gtest/gtest.h>

#include <thread>

#include "tests/support/shapes.h"
#include "tests/wave/wave_fixture.h"

namespace geotherm::test {
namespace {

class WaveThreads : public testing::TestWithParam<MethodKind> {
 protected:
  MeshPtr mesh = finish(jittered_plane(60, 0.3, 9));  // worth several threads
  std::vector<SourceSet> sets = [] {
    std::vector<SourceSet> out;
    for (Index i = 0; i < 12; ++i) out.push_back(SourceSet::of_vertices({31 * i, 7 + 5 * i}));
    return out;
  }();
};

TEST_P(WaveThreads, DoNotChangeTheAnswers) {
  const auto alone = method_of(mesh, GetParam(), 1);
  for (const int threads : {2, 5}) {
    const auto results = method_of(mesh, GetParam(), threads)->solve_each(sets);
    ASSERT_TRUE(results) << results.error().message;
    ASSERT_EQ(results->size(), sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i) {
      EXPECT_EQ((*results)[i].distances, solve(*alone, sets[i]).distances) << i;
    }
  }
}

TEST_P(WaveThreads, MayAskOneMethodConcurrently) {
  const auto method = method_of(mesh, GetParam(), 1);
  std::vector<DistanceResult> results(sets.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      threads.emplace_back([&, i] { results[i] = solve(*method, sets[i], {true, false, true}); });
    }
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ(results[i].distances, solve(*method, sets[i]).distances) << i;
  }
}

TEST_P(WaveThreads, StopTogetherWhenOneSetIsBad) {
  sets[7] = SourceSet::of_vertices({-1});
  const auto results = method_of(mesh, GetParam(), 3)->solve_each(sets);
  ASSERT_FALSE(results);
  EXPECT_EQ(results.error().code, ErrorCode::kBadInput);
}

INSTANTIATE_TEST_SUITE_P(Methods, WaveThreads, testing::ValuesIn(kWaveKinds),
                         [](const auto& each) { return kind_name(each.param); });

}  // namespace
}  // namespace geotherm::test
