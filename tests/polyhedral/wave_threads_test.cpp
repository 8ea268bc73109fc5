// SPDX-License-Identifier: MIT
// The same distances, to the last bit, for any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "solver/polyhedral/wave_tables.h"
#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/shapes.h"

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

TEST(WaveTables, AreTheSameForAnyNumberOfThreads) {
  Draft draft = jittered_plane(130, 0.3, 4);  // worth two pieces of each pass
  for (Index i = 0; i < 40; ++i) {            // fins, whose edges have three faces
    const Face face = draft.faces[static_cast<std::size_t>(200 * i)];
    draft.positions.emplace_back(draft.positions[face[0]] + Vec3(0, 0, 0.01));
    draft.faces.push_back({face[0], face[1], static_cast<Index>(draft.positions.size()) - 1});
  }
  const auto surface = build_wave_surface(finish(draft));
  ASSERT_TRUE(surface) << surface.error().message;
  const WaveTables alone = build_wave_tables(**surface, 1);
  ASSERT_FALSE(alone.more.empty());
  for (const int threads : {2, 5}) {
    const WaveTables tables = build_wave_tables(**surface, threads);
    EXPECT_EQ(tables.vertex_of_rank, alone.vertex_of_rank);
    EXPECT_TRUE(std::ranges::equal(tables.intrinsic_face, alone.intrinsic_face));
    EXPECT_EQ(tables.sides, alone.sides);
    EXPECT_EQ(tables.more, alone.more);
    EXPECT_EQ(tables.corners, alone.corners);
    EXPECT_EQ(tables.mean_side, alone.mean_side);
    for (std::size_t f = 0; f < alone.faces.size(); ++f) {
      EXPECT_EQ(tables.faces[f].edge, alone.faces[f].edge) << f;
      EXPECT_EQ(tables.faces[f].reversed, alone.faces[f].reversed) << f;
      EXPECT_EQ(tables.faces[f].touching, alone.faces[f].touching) << f;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, WaveThreads, testing::ValuesIn(kWaveKinds),
                         [](const auto& each) { return kind_name(each.param); });

}  // namespace
}  // namespace geotherm::test
