// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "solver/geometry/intrinsic_surface.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

IntrinsicSurface surface_of(Draft draft) {
  auto surface = build_intrinsic_surface(finish(std::move(draft)), {});
  EXPECT_TRUE(surface) << surface.error().message;
  return surface ? *std::move(surface) : IntrinsicSurface{};
}

TEST(CleanPoint, HasWeightsThatSumToOneWhateverIsClipped) {
  constexpr double kThreeRoundings = 4e-16;
  const IntrinsicSurface surface = surface_of(sphere(1));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> off(-3e-7, 3e-7), inside(0.1, 0.9);
  for (int i = 0; i < 1000; ++i) {
    const double w = inside(random);
    const auto given = SurfacePoint::in_face(i % 80, {off(random), w, 1 - w});
    ASSERT_TRUE(check_sources(surface, {{given}, {}}));
    const SurfacePoint clean = clean_point(surface, given);
    ASSERT_FALSE(clean.is_vertex());
    const auto& weights = clean.weights;
    EXPECT_GE(std::ranges::min(weights), 0);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, kThreeRoundings);
  }
}

TEST(CleanPoint, IsAVertexOfEveryFaceWithoutAnInsideThatIsAccepted) {
  Draft draft = sphere(1);
  draft.faces.push_back({1, 2, 1});
  const auto last = static_cast<Index>(draft.faces.size()) - 1;
  const IntrinsicSurface surface = surface_of(std::move(draft));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> near(0.999 * kAtCorner, 1.001 * kAtCorner);
  std::uniform_real_distribution<double> scale(1 - 5e-7, 1 + 5e-7), below(-2e-7, 0);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 10000; ++i) {
    const double part = near(random), whole = scale(random);
    const auto given = SurfacePoint::in_face(
        last, {whole * (1 - part), i % 2 == 0 ? 0 : below(random), whole * part});
    if (!check_sources(surface, {{given}, {}})) {
      ++refused;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(clean_point(surface, given).is_vertex());
  }
  EXPECT_GT(accepted, 0);
  EXPECT_GT(refused, 0);
}

TEST(FindCleanEdge, FindsEveryEdgeAndNothingElse) {
  Draft draft = pyramid(50, 2, 0.1);  // vertex 0 has fifty edges
  const IntrinsicSurface surface = surface_of(draft);
  const EdgeTable& edges = surface.kept->edges;
  Index found = 0;
  for (Index a = 0; a < draft.vertex_count(); ++a) {
    for (Index b = a + 1; b < draft.vertex_count(); ++b) {
      const Index edge = find_clean_edge(surface, b, a);
      EXPECT_EQ(edge, find_clean_edge(surface, a, b));
      if (edge == kNoIndex) continue;
      ++found;
      EXPECT_TRUE(edges.low(edge) == a && edges.high(edge) == b);
    }
  }
  EXPECT_EQ(found, edges.edge_count());
}

}  // namespace
}  // namespace geotherm::test
