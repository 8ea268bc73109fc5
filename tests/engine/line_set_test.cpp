// SPDX-License-Identifier: MIT
#include "engine/scene/line_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;
using Points = std::vector<glm::vec3>;

/// A wave with many points.
Points wave(std::size_t count) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count - 1);
    points.emplace_back(2 * t - 1, 0.2F * std::sin(9 * t), 0.1F * std::cos(5 * t));
  }
  return points;
}

float distance(const glm::vec3& p, const Points& line) {
  float least = 1e9F;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const glm::vec3 way = line[i] - line[i - 1];
    const float t = glm::clamp(glm::dot(p - line[i - 1], way) / glm::dot(way, way), 0.0F, 1.0F);
    least = std::min(least, glm::length(p - line[i - 1] - t * way));
  }
  return least;
}

class SimplifiedLine : public testing::TestWithParam<float> {};

TEST_P(SimplifiedLine, StaysWithinItsToleranceAndKeepsItsEnds) {
  const Points all = wave(3000);
  const Points few = simplified(all, GetParam());
  EXPECT_EQ(few.front(), all.front());
  EXPECT_EQ(few.back(), all.back());
  constexpr float kRounding = 1e-6F;
  for (const glm::vec3& p : all) ASSERT_LE(distance(p, few), GetParam() + kRounding);
}

INSTANTIATE_TEST_SUITE_P(All, SimplifiedLine, testing::Values(0.0F, 1e-5F, 1e-3F, 0.1F),
                         [](const auto& test) { return std::to_string(test.index); });

TEST(SimplifiedLine, NeedsFewPoints) {
  EXPECT_LE(simplified(wave(3000), 1e-3F).size(), 60U);
  EXPECT_EQ(simplified(Points{{0, 0, 0}, {1, 0, 0}}, 1).size(), 2U);
  EXPECT_EQ(simplified(Points{{0, 0, 0}}, 1).size(), 1U);
  EXPECT_TRUE(simplified({}, 1).empty());
}

TEST(LineSets, HaveMorePiecesTheCloserTheEyeIs) {
  const Points points = wave(3000);
  const Polyline line{points, {1, 0, 0}};
  LineSet set;
  set.set({&line, 1});
  Orbit orbit;
  const glm::vec2 extent(1280, 720);
  EXPECT_TRUE(set.fit(make_camera(orbit, points, extent)));
  EXPECT_FALSE(set.fit(make_camera(orbit, points, extent)));
  const std::size_t before = set.pieces().size();
  EXPECT_LE(before, 200U);
  orbit.zoom = 50;
  EXPECT_TRUE(set.fit(make_camera(orbit, points, extent)));
  EXPECT_GT(set.pieces().size(), 2 * before);
  ASSERT_EQ(set.ranges().size(), 1U);
  EXPECT_EQ(set.ranges()[0].count, set.pieces().size());
  set.set({});
  EXPECT_TRUE(set.fit(make_camera(orbit, points, extent)));
  EXPECT_TRUE(set.ranges().empty());
}

TEST(LineSets, ThatPassTheEyeAreFine) {
  const Points points = {{0, 0, -1}, {0, 0, 50}, {0, 0, 100}};
  const Polyline line{points, {}};
  LineSet set;
  set.set({&line, 1});
  EXPECT_TRUE(set.fit(make_camera({}, Points{{-1, -1, -1}, {1, 1, 1}}, {320, 240})));
  EXPECT_GE(set.pieces().size(), 1U);
}

}  // namespace
}  // namespace geotherm::test
