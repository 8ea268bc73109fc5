// SPDX-License-Identifier: MIT
#include "geotherm/many.h"

#include <gtest/gtest.h>

#include <atomic>

#include "geotherm/build_method.h"
#include "tests/support/compare.h"
#include "tests/support/no_threads.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

constexpr int kLevel = 3;  // 642 vertices
constexpr std::size_t kStreamSets = 21;

std::vector<SourceSet> streamed_sets() {
  std::vector<SourceSet> sets;
  for (std::size_t i = 0; i < kStreamSets; ++i) {
    sets.push_back(SourceSet::of_vertices({static_cast<Index>(7 * i + 3)}));
  }
  return sets;
}

std::shared_ptr<const DistanceMethod> method_on_threads(MethodKind kind, int threads) {
  MethodOptions options;
  options.method = kind;
  options.threads = threads;
  return *build_method(finish(sphere(kLevel)), options);
}

class StreamOfAnswers : public testing::TestWithParam<MethodKind> {};

TEST_P(StreamOfAnswers, HasTheBitsOfOneCallWhateverThreadsAndChunksOfSixteen) {
  const auto sets = streamed_sets();
  const auto all = method_on_threads(GetParam(), 1)->solve_each(sets);
  ASSERT_TRUE(all);
  for (const int threads : {1, 3}) {
    const auto method = method_on_threads(GetParam(), threads);
    for (const std::size_t chunk : {std::size_t{16}, std::size_t{32}, std::size_t{96}}) {
      std::size_t next = 0;
      const auto sink = [&](std::size_t set, DistanceResult&& answer) -> Result<void> {
        EXPECT_EQ(set, next++);
        EXPECT_EQ(answer.distances, (*all)[set].distances) << set;
        return {};
      };
      const auto done = stream_answers(*method, sets, {chunk, {}}, sink);
      EXPECT_TRUE(done) << done.error().message;
      EXPECT_EQ(next, kStreamSets);
    }
  }
}

TEST_P(StreamOfAnswers, HasThoseOfSingleSolves) {
  constexpr double kRoundOff = 1e-12;  // of the largest distance: blocks of columns round otherwise
  const auto sets = streamed_sets();
  const auto method = method_on_threads(GetParam(), 1);
  const auto done = stream_answers(
      *method, sets, {5, {}}, [&](std::size_t set, DistanceResult&& answer) -> Result<void> {
        const auto single = method->solve(sets[set]);
        EXPECT_LE(relative_difference(answer.distances, single->distances), kRoundOff);
        if (GetParam() != MethodKind::kHeat) {
          EXPECT_EQ(answer.distances, single->distances);
        }
        return {};
      });
  EXPECT_TRUE(done);
}

INSTANTIATE_TEST_SUITE_P(Of, StreamOfAnswers,
                         testing::Values(MethodKind::kHeat, MethodKind::kWavefront,
                                         MethodKind::kExact),
                         [](const auto& test) { return to_text(test.param); });

// A source on a Dirichlet border changes the matrix and is solved alone; the blocks of the others
// must not move because of it.
TEST(StreamAnswers, HaveTheBitsOfOneCallBesideASourceThatIsSolvedAlone) {
  constexpr Index kCells = 24;
  MethodOptions options;
  options.boundary = BoundaryRule::kDirichlet;
  options.threads = 1;
  const auto method = build_method(finish(jittered_plane(kCells, 0.3, 2)), options);
  ASSERT_TRUE(method) << method.error().message;
  std::vector<SourceSet> sets;
  for (Index i = 0; i < 20; ++i) {
    sets.push_back(SourceSet::of_vertices({grid_vertex(kCells, 2 + i, 9)}));
  }
  sets[2] = SourceSet::of_vertices({grid_vertex(kCells, 5, 0)});  // on the border
  const auto all = (*method)->solve_each(sets);
  ASSERT_TRUE(all) << all.error().message;
  const auto done = stream_answers(**method, sets, {16, {}},
                                   [&](std::size_t set, DistanceResult&& answer) -> Result<void> {
                                     EXPECT_EQ(answer.distances, (*all)[set].distances) << set;
                                     return {};
                                   });
  EXPECT_TRUE(done);
}

TEST(StreamAnswers, NeedsNoThreadBesideTheCallers) {
  const auto method = method_on_threads(MethodKind::kWavefront, 1);
  const NoThreads none;
  if (!none.works()) GTEST_SKIP() << "threads start here whatever their stacks";
  std::size_t taken = 0;
  const auto done =
      stream_answers(*method, streamed_sets(), {4, {}}, [&](std::size_t, DistanceResult&&) {
        ++taken;
        return Result<void>();
      });
  EXPECT_TRUE(done);
  EXPECT_EQ(taken, kStreamSets);
}

TEST(StreamAnswers, CallNoSinkAgainAfterItsError) {
  const auto method = method_on_threads(MethodKind::kWavefront, 1);
  std::atomic<int> calls = 0;
  const auto done = stream_answers(*method, streamed_sets(), {4, {}},
                                   [&](std::size_t set, DistanceResult&&) -> Result<void> {
                                     ++calls;
                                     if (set < 5) return {};
                                     return Error{ErrorCode::kBadFile, "the disk is full"};
                                   });
  ASSERT_FALSE(done);
  EXPECT_EQ(sentence(done.error()), "the disk is full");
  EXPECT_EQ(calls, 6);
}

TEST(StreamAnswers, PassOnTheErrorOfASetAndTheAnswersOfTheChunksBefore) {
  auto sets = streamed_sets();
  sets[9] = SourceSet::of_vertices({100000});
  std::size_t taken = 0;
  const auto done = stream_answers(*method_on_threads(MethodKind::kHeat, 2), sets, {4, {}},
                                   [&](std::size_t, DistanceResult&&) -> Result<void> {
                                     ++taken;
                                     return {};
                                   });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(done.error()).find("100000"), std::string::npos);
  EXPECT_EQ(taken, 8U);
}

TEST(StreamAnswers, CanBeCancelledBetweenChunksAndSayWhatIsDone) {
  std::vector<double> shares;
  const auto done = stream_answers(
      *method_on_threads(MethodKind::kHeat, 1), streamed_sets(), {4, {}},
      [](std::size_t, DistanceResult&&) { return Result<void>(); },
      [&](std::string_view stage, double share) {
        if (stage == kSourcesStage) shares.push_back(share);
        return shares.size() < 3;
      });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kCancelled);
  ASSERT_EQ(shares.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(shares[i], 4.0 * static_cast<double>(i + 1) / kStreamSets);
  }
}

TEST(GoodChunk, FillsThreadsAndStaysInMemory) {
  constexpr std::int64_t kPlenty = std::int64_t{1} << 40;
  EXPECT_EQ(good_chunk(1000, 2, kPlenty), 64U);
  EXPECT_EQ(good_chunk(1000, 2, {}), 64U);
  EXPECT_EQ(good_chunk(100'000'000, 2, kPlenty), 32U);
  for (const std::int64_t free : {std::int64_t{1} << 31, std::int64_t{1} << 29}) {
    const std::size_t chunk = good_chunk(1'000'000, 8, free);
    EXPECT_LE(chunk_bytes(1'000'000, chunk), free / 2) << free;
    EXPECT_EQ(chunk % 16, 0U);
  }
  EXPECT_EQ(good_chunk(1'000'000, 8, 0), 16U);
}

}  // namespace
}  // namespace geotherm::test
