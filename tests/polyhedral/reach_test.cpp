// SPDX-License-Identifier: MIT
// Queries that go no farther than asked: to the last bit what all of the answer has there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "tests/polyhedral/wave_fixture.h"

namespace geotherm::test {
namespace {

constexpr MethodKind kAll[] = {MethodKind::kWavefront, MethodKind::kWavefrontFine,
                               MethodKind::kFastMarching, MethodKind::kExact, MethodKind::kHeat};

double farthest(const std::vector<double>& distances) {
  double most = 0;
  for (const double d : distances) {
    if (d < kUnreached) most = std::max(most, d);
  }
  return most;
}

QueryOptions within(Reach reach) { return {.quality = false, .nearest = false, .reach = reach}; }

class ReachOnTheZoo : public MethodOnMesh {
 protected:
  SourceSet set = SourceSet::of_vertices({mesh->faces().front()[0]});
  std::vector<double> all = solve(*method, set, {.quality = false}).distances;
};

/// Many radii one after the other, so that each finds what the one before has left.
TEST_P(ReachOnTheZoo, HasTheBitsOfTheWholeAnswerWithin) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.01, 1.0);
  for (int i = 0; i < 20; ++i) {
    const double most = share(random) * share(random) * farthest(all);
    if (!(most > 0)) continue;
    const auto near = solve(*method, set, within({.max_distance = most}));
    ASSERT_EQ(near.distances.size(), all.size());
    const auto few = solve(*method, set, within({.max_distance = most, .sparse = true}));
    std::size_t next = 0;
    for (std::size_t v = 0; v < all.size(); ++v) {
      ASSERT_EQ(near.distances[v], all[v] <= most ? all[v] : kUnreached) << v << " within " << most;
      if (!(all[v] <= most)) continue;
      ASSERT_LT(next, few.vertices.size());
      ASSERT_EQ(few.vertices[next], static_cast<Index>(v));
      ASSERT_EQ(few.distances[next++], all[v]);
    }
    ASSERT_EQ(next, few.vertices.size());
    ASSERT_EQ(next, few.distances.size());
  }
}

TEST_P(ReachOnTheZoo, HasTheBitsOfTheWholeAnswerAtTargets) {
  std::mt19937 random(11);
  std::uniform_int_distribution<Index> any(0, mesh->vertex_count() - 1);
  for (int i = 0; i < 20; ++i) {
    const std::vector<Index> targets = {any(random), any(random), any(random)};
    const auto at = solve(*method, set, within({.targets = targets}));
    ASSERT_EQ(at.vertices, targets);
    ASSERT_EQ(at.distances.size(), targets.size());
    for (std::size_t k = 0; k < targets.size(); ++k) {
      EXPECT_EQ(at.distances[k], all[targets[k]]) << "vertex " << targets[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, ReachOnTheZoo,
                         testing::Combine(testing::ValuesIn(zoo()), testing::ValuesIn(kAll)),
                         name_and_kind);

/// Of methods that know the nearest source and offsets, which are all but heat.
class ReachesOfSources : public testing::TestWithParam<MethodKind> {};

TEST_P(ReachesOfSources, KnowTheNearestOfSeveralWithOffsets) {
  const MeshPtr mesh = finish(sphere(4));
  const auto method = method_of(mesh, GetParam());
  SourceSet set = SourceSet::of_vertices({0, 100, 900});
  set.offsets = {0.25, 0.5, 0.75};
  const auto all = solve(*method, set, {.quality = false, .nearest = true});
  for (const double most : {0.2, 0.4, 0.8, 1.6}) {
    const auto near =
        solve(*method, set, {.quality = false, .nearest = true, .reach = {.max_distance = most}});
    for (std::size_t v = 0; v < all.distances.size(); ++v) {
      const bool is_near = all.distances[v] <= most;
      ASSERT_EQ(near.distances[v], is_near ? all.distances[v] : kUnreached);
      ASSERT_EQ(near.nearest_source[v], is_near ? all.nearest_source[v] : kNoIndex);
    }
  }
}

class Reaches : public testing::TestWithParam<MethodKind> {};

TEST_P(Reaches, AreTheSameOnRefinedMeshes) {
  const MeshPtr mesh = finish(torus(24, 12, 0.4));
  MethodOptions options;
  options.method = GetParam();
  options.refine = 1;
  const auto method = build_method(mesh, options);
  ASSERT_TRUE(method);
  const SourceSet set = SourceSet::of_vertices({5});
  const auto all = solve(**method, set, {.quality = false});
  const auto few = solve(**method, set, within({.max_distance = 1, .sparse = true}));
  ASSERT_FALSE(few.vertices.empty());
  for (std::size_t i = 0; i < few.vertices.size(); ++i) {
    EXPECT_EQ(few.distances[i], all.distances[few.vertices[i]]);
  }
  const auto count = std::ranges::count_if(all.distances, [](double d) { return d <= 1; });
  EXPECT_EQ(std::ssize(few.vertices), count);
  const auto at = solve(**method, set, within({.targets = {7, 100}}));
  EXPECT_EQ(at.distances, (std::vector<double>{all.distances[7], all.distances[100]}));
}

TEST_P(Reaches, ThatAreNoneAreRefused) {
  const auto method = method_of(finish(sphere(2)), GetParam());
  const SourceSet set = SourceSet::of_vertices({5});
  for (const double most : {0.0, -1.0, std::nan("")}) {
    const auto result = method->solve(set, within({.max_distance = most}));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  }
  for (const Index v : {-1, 162}) {
    const auto result = method->solve(set, within({.targets = {3, v}}));
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("target 1 is vertex"), std::string::npos);
  }
}

std::vector<MethodKind> all_but_heat() {
  std::vector<MethodKind> kinds(std::begin(kAll), std::end(kAll));
  std::erase(kinds, MethodKind::kHeat);
  return kinds;
}
INSTANTIATE_TEST_SUITE_P(Methods, ReachesOfSources, testing::ValuesIn(all_but_heat()),
                         [](const auto& each) { return kind_name(each.param); });
INSTANTIATE_TEST_SUITE_P(Methods, Reaches, testing::ValuesIn(kAll),
                         [](const auto& each) { return kind_name(each.param); });

/// Distance in the plane is known, and a disc in the middle ends long before the border: what was
/// not reached costs nothing, so that the time is that of the disc.
TEST(ReachOfWaves, TakesTheTimeOfWhatIsReachedSlow) {
  constexpr Index kSide = 400;
  const MeshPtr mesh = finish(plane_grid(kSide, kSide, 1, 1));
  for (const MethodKind kind :
       {MethodKind::kWavefront, MethodKind::kWavefrontFine, MethodKind::kFastMarching}) {
    const auto method = method_of(mesh, kind);
    const SourceSet set = SourceSet::of_vertices({grid_vertex(kSide, kSide / 2, kSide / 2)});
    const QueryOptions near = within({.max_distance = 0.0564, .sparse = true});
    double whole = kUnreached, part = kUnreached;
    for (int i = 0; i < 5; ++i) {
      whole = std::min(whole, solve(*method, set, {.quality = false}).timing.query);
      part = std::min(part, solve(*method, set, near).timing.query);
    }
    const auto few = solve(*method, set, near);
    EXPECT_NEAR(static_cast<double>(few.vertices.size()), 0.01 * kSide * kSide,
                0.0005 * kSide * kSide);
    EXPECT_GT(whole / part, 20) << kind_name(kind) << ": " << whole << " and " << part << " ms";
  }
}

}  // namespace
}  // namespace geotherm::test
