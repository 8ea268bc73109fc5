// SPDX-License-Identifier: MIT
// Many fans that touch at one vertex.
#include <gtest/gtest.h>

#include <random>

#include "solver/polyhedral/wave_front.h"
#include "tests/polyhedral/wave_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// Triangles in all directions that share vertex 0 and nothing else.
Draft fan_book(Index pages) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto somewhere = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  Draft draft;
  draft.add({0, 0, 0});
  for (Index p = 0; p < pages; ++p) {
    const Vec3 middle = 3 * somewhere();
    const Index first = draft.add(middle + somewhere());
    const Index second = draft.add(middle + somewhere());
    draft.faces.push_back({0, first, second});
  }
  return draft;
}

class FanBook : public testing::TestWithParam<int> {
 protected:
  /// Work of a wave from the end of a page.
  std::size_t visits(Index pages) const {
    const auto surface = build_wave_surface(finish(fan_book(pages)));
    EXPECT_TRUE(surface);
    const auto seeds = seed_sources(**surface, SourceSet::of_vertices({1}));
    EXPECT_TRUE(seeds);
    const WaveTables tables = build_wave_tables(**surface);
    WaveFront front(tables, GetParam());
    EXPECT_EQ(front.run(**surface, *seeds, false, {}), WaveFront::Outcome::kDone);
    return front.visits();
  }
};

TEST_P(FanBook, OfFourTimesAsManyPagesIsFourTimesTheWork) {
  // It would be 16 times, if every page handed the distance on to all.
  constexpr std::size_t kMore = 4, kSome = 2;
  constexpr Index kPages = 1000;
  EXPECT_LE(visits(kMore * kPages), kSome * kMore * visits(kPages));
}

INSTANTIATE_TEST_SUITE_P(Samples, FanBook, testing::Values(1, 3));

class FanBookDistances : public testing::TestWithParam<MethodKind> {};

TEST_P(FanBookDistances, LeadThroughTheVertexThatAllShare) {
  constexpr double kRoundOff = 1e-12;
  const Draft draft = fan_book(500);
  const auto d = distances(finish(draft), GetParam(), SourceSet::of_vertices({1}));
  std::vector<double> expected;
  for (const Vec3& p : draft.positions) expected.push_back(draft.positions[1].norm() + p.norm());
  expected[1] = 0;
  expected[2] = (draft.positions[1] - draft.positions[2]).norm();
  EXPECT_LE(relative_difference(d, expected), kRoundOff);
}

INSTANTIATE_TEST_SUITE_P(Methods, FanBookDistances,
                         testing::Values(MethodKind::kWavefront, MethodKind::kWavefrontFine,
                                         MethodKind::kFastMarching, MethodKind::kExact),
                         [](const auto& each) { return kind_name(each.param); });

}  // namespace
}  // namespace geotherm::test
