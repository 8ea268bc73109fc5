// SPDX-License-Identifier: MIT
#include "engine/scene/coarse_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// A sphere of radius 1 in rows and columns of latitude and longitude.
struct Ball {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;

  explicit Ball(std::uint32_t n) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= 2 * n; ++j) {
        const float a = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(n);
        const float b = std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(n);
        positions.emplace_back(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
        if (i == n || j == 2 * n) continue;
        const std::uint32_t at = i * (2 * n + 1) + j, below = at + 2 * n + 1;
        faces.push_back({at, at + 1, below});
        faces.push_back({below, at + 1, below + 1});
      }
    }
  }
  SurfaceGeometry geometry() const { return {positions, faces}; }
};

constexpr std::size_t kWanted = 5000;

TEST(CoarseSurface, HasAboutAsManyFacesAsWanted) {
  const Ball ball(200);
  ASSERT_GT(ball.faces.size(), 150'000U);
  const CoarseSurface coarse = coarse_surface(ball.geometry(), kWanted);
  EXPECT_GT(coarse.faces.size(), kWanted / 2);
  EXPECT_LT(coarse.faces.size(), kWanted * 2);
}

TEST(CoarseSurface, StaysNearTheSurfaceAndHasNoHoles) {
  const Ball ball(200);
  const CoarseSurface coarse = coarse_surface(ball.geometry(), kWanted);
  for (const glm::vec3& p : coarse.positions) EXPECT_NEAR(glm::length(p), 1, 0.02);
  double area = 0;
  for (const auto& [a, b, c] : coarse.faces) {
    const auto& p = coarse.positions;
    area += 0.5 * glm::length(glm::cross(p[b] - p[a], p[c] - p[a]));
  }
  EXPECT_NEAR(area, 4 * std::numbers::pi, 0.05 * 4 * std::numbers::pi);
}

TEST(CoarseSurface, SaysWhatBecameOfEachVertexAndFace) {
  const Ball ball(60);
  const CoarseSurface coarse = coarse_surface(ball.geometry(), kWanted);
  ASSERT_EQ(coarse.of_vertex.size(), ball.positions.size());
  ASSERT_EQ(coarse.origin.size(), coarse.faces.size());
  for (std::size_t i = 0; i < coarse.example.size(); ++i) {
    EXPECT_EQ(coarse.of_vertex[coarse.example[i]], i);
  }
  for (std::size_t f = 0; f < coarse.faces.size(); ++f) {
    const auto& before = ball.faces[coarse.origin[f]];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(coarse.faces[f][k], coarse.of_vertex[before[k]]);
    }
  }
}

TEST(CoarseSurface, TakesTheMeanOfTheValuesThatThereAre) {
  const Ball ball(120);
  const CoarseSurface coarse = coarse_surface(ball.geometry(), 2000);
  std::vector<float> heights;
  for (const glm::vec3& p : ball.positions) heights.push_back(p.x > 0.5F ? kNoValue : p.y);
  const std::vector<float> means = coarse.means(heights);
  for (std::size_t i = 0; i < means.size(); ++i) {
    const glm::vec3& p = coarse.positions[i];
    if (p.x > 0.6F) {
      EXPECT_EQ(means[i], kNoValue);
    } else if (p.x < 0.4F) {
      EXPECT_NEAR(means[i], p.y, 1e-4);
    }
  }
}

TEST(CoarseSurface, OfAPointHasNoFaces) {
  Ball dot(8);
  for (glm::vec3& p : dot.positions) p *= 1e-9F;
  EXPECT_TRUE(coarse_surface(dot.geometry(), 100).faces.empty());
}

}  // namespace
}  // namespace geotherm::test
