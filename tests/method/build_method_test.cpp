// SPDX-License-Identifier: MIT
#include "geotherm/build_method.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/models/generate.h"

namespace geotherm {
namespace {

class EveryMethod : public testing::TestWithParam<std::string> {
 protected:
  EveryMethod() : mesh_(std::make_shared<const TriangleMesh>(*generate_model("cube", 3000))) {}

  std::shared_ptr<const DistanceMethod> built() const {
    MethodOptions options;
    options.method = *parse<MethodKind>(GetParam());
    auto method = build_method(mesh_, options);
    EXPECT_TRUE(method) << method.error().message;
    return *method;
  }

  std::shared_ptr<const TriangleMesh> mesh_;
};

TEST_P(EveryMethod, HasItsNameAndTheSameDistancesWithinItsError) {
  const auto method = built();
  EXPECT_EQ(to_text(method->kind()), GetParam());
  MethodOptions exact;
  exact.method = MethodKind::kExact;
  const SourceSet source = SourceSet::of_vertices({0});
  const auto expected = (*build_method(mesh_, exact))->solve(source);
  const auto result = method->solve(source);
  ASSERT_TRUE(result) << result.error().message;
  double most = 0, off = 0;
  for (std::size_t v = 0; v < expected->distances.size(); ++v) {
    most = std::max(most, expected->distances[v]);
    off = std::max(off, std::abs(result->distances[v] - expected->distances[v]));
  }
  constexpr double kHeat = 0.08;  // of the range, on a mesh so coarse; the others are below
  EXPECT_LE(off, kHeat * most);
  EXPECT_EQ(result->distances[0], 0);
}

TEST_P(EveryMethod, AnswersSetsTogetherAsAlone) {
  const auto method = built();
  const std::vector<SourceSet> sets = {SourceSet::of_vertices({0}), SourceSet::of_vertices({5, 9}),
                                       SourceSet::of_vertices({17})};
  const auto together = method->solve_each(sets);
  ASSERT_TRUE(together);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto alone = method->solve(sets[i]);
    ASSERT_TRUE(alone);
    for (std::size_t v = 0; v < alone->distances.size(); ++v) {
      // Blocks of right-hand sides are summed in another order.
      EXPECT_NEAR((*together)[i].distances[v], alone->distances[v], 1e-9);
    }
  }
}

TEST_P(EveryMethod, RefusesWhatIsNotOnTheMesh) {
  const auto method = built();
  for (const SourceSet& bad :
       {SourceSet{}, SourceSet::of_vertices({-1}), SourceSet::of_vertices({1'000'000})}) {
    const auto result = method->solve(bad);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  }
}

TEST_P(EveryMethod, RefusesToWorkOnFewerThreadsThanNone) {
  MethodOptions options;
  options.method = *parse<MethodKind>(GetParam());
  options.threads = -4;
  for (const auto& made :
       {build_method(mesh_, options), build_method_moved(mesh_, options, built().get())}) {
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::kBadInput);
    EXPECT_NE(made.error().message.find("-4"), std::string::npos) << made.error().message;
  }
}

TEST_P(EveryMethod, KnowsOffsetsOrSaysThatItDoesNot) {
  const auto method = built();
  SourceSet sources = SourceSet::of_vertices({0, 40});
  sources.offsets = {0.5, 0};
  const auto result = method->solve(sources);
  if (method->heat() != nullptr) {
    ASSERT_FALSE(result);
    EXPECT_NE(sentence(result.error()).find("wavefront"), std::string::npos);
    return;
  }
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->distances[40], 0);
  EXPECT_LE(result->distances[0], 0.5);
  sources.offsets = {-1, 0};
  EXPECT_FALSE(method->solve(sources)) << "a negative offset";
}

INSTANTIATE_TEST_SUITE_P(Names, EveryMethod, testing::ValuesIn(all_names<MethodKind>()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(MethodKindTest, ListsTheNamesWhereThereIsNone) {
  const auto none = parse<MethodKind>("geodesic");
  ASSERT_FALSE(none);
  for (const std::string& name : all_names<MethodKind>()) {
    EXPECT_NE(sentence(none.error()).find(name), std::string::npos) << name;
  }
}

TEST(SameMethodTest, OptionsOfHeatDoNotChangeAnotherMethod) {
  MethodOptions a, b;
  b.time_step.factor = 2;
  EXPECT_FALSE(same_method(a, b));
  a.method = b.method = MethodKind::kWavefront;
  EXPECT_TRUE(same_method(a, b));
}

TEST(SourceGroupsTest, TouchingEdgesAndTheirEndsAreOneGroup) {
  SourceSet set = SourceSet::of_vertices({4, 9});
  set.edges = {{1, 2}, {2, 4}, {7, 8}};
  const SourceGroups groups = source_groups(set);
  EXPECT_EQ(groups.count, 3);
  EXPECT_EQ(groups.of_point, (std::vector<Index>{1, 0})) << "points by themselves come first";
  EXPECT_EQ(groups.of_edge, (std::vector<Index>{1, 1, 2}));
}

TEST(SourceGroupsTest, CurvesAreNumberedAsTheirPointsStand) {
  SourceSet set = SourceSet::of_vertices({8, 9, 4, 3});
  set.edges = {{1, 2}, {2, 4}, {7, 8}, {5, 6}};
  set.segments = {{0, {1, 0, 0}, {0, 1, 0}, 0}};
  const SourceGroups groups = source_groups(set);
  EXPECT_EQ(groups.of_point, (std::vector<Index>{2, 0, 3, 1}));
  EXPECT_EQ(groups.of_edge, (std::vector<Index>{3, 3, 2, 4}));
  EXPECT_EQ(groups.of_segment, (std::vector<Index>{5}));
}

}  // namespace
}  // namespace geotherm
