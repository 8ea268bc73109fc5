// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/scene/camera.h"

namespace geotherm::test {
namespace {

using engine::Camera;
using engine::Fit;
using engine::Insets;
using engine::make_camera;
using engine::Orbit;
using glm::vec2;
using glm::vec3;

/// Pixels by which single precision may be off in pictures of up to 4096 pixels.
constexpr float kFitPixel = 0.02F;

/// The free distance of what is seen to the sides of what the insets leave, pixels.
struct Slack {
  float left, top, right, bottom;
  float horizontal() const { return std::min(left, right); }
  float vertical() const { return std::min(top, bottom); }
};

Slack slack_of(const Camera& camera, const std::vector<vec3>& points, const Insets& insets) {
  vec2 min(std::numeric_limits<float>::max());
  vec2 max(-min);
  for (const vec3& p : points) {
    min = glm::min(min, vec2(camera.project(p)));
    max = glm::max(max, vec2(camera.project(p)));
  }
  return {min.x - insets.left, min.y - insets.top, camera.extent.x - insets.right - max.x,
          camera.extent.y - insets.bottom - max.y};
}

/// One random cloud, direction, picture and lens a seed.
struct FitCase {
  std::vector<vec3> points;
  Orbit orbit;
  vec2 extent;
  Insets insets;
};

FitCase random_fit(unsigned seed, bool orthographic) {
  std::mt19937 random(seed);
  const auto between = [&random](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  FitCase made;
  const vec3 centre(between(-0.3F, 0.3F), between(-0.3F, 0.3F), between(-0.3F, 0.3F));
  const vec3 half(between(0.05F, 0.4F), between(0.05F, 0.4F), between(0.05F, 0.4F));
  const int count = 4 + static_cast<int>(between(0, 200));
  for (int i = 0; i < count; ++i) {
    made.points.push_back(centre + half * vec3(between(-1, 1), between(-1, 1), between(-1, 1)));
  }
  made.orbit.azimuth = between(-360, 360);
  made.orbit.elevation = between(-90, 90);
  made.orbit.field_of_view = between(10, 50);
  made.orbit.orthographic = orthographic;
  made.extent = {std::round(between(50, 4096)), std::round(between(50, 4096))};
  made.insets = {0.3F * between(0, 1) * made.extent.x, 0.3F * between(0, 1) * made.extent.y,
                 0.3F * between(0, 1) * made.extent.x, 0.3F * between(0, 1) * made.extent.y};
  return made;
}

class CameraFit : public testing::TestWithParam<bool> {};  // orthographic or not

TEST_P(CameraFit, TouchesTheRegionOnOppositeSidesAndNeverLeavesIt) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const FitCase made = random_fit(seed, GetParam());
    const Camera camera = make_camera(made.orbit, made.points, made.extent, made.insets);
    const Slack slack = slack_of(camera, made.points, made.insets);
    EXPECT_GE(slack.horizontal(), -kFitPixel) << seed;
    EXPECT_GE(slack.vertical(), -kFitPixel) << seed;
    EXPECT_LE(std::min(slack.horizontal(), slack.vertical()), kFitPixel) << seed;
  }
}

TEST_P(CameraFit, CentresTheModelInTheRegion) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const FitCase made = random_fit(seed, GetParam());
    const Camera camera = make_camera(made.orbit, made.points, made.extent, made.insets);
    const Slack slack = slack_of(camera, made.points, made.insets);
    EXPECT_NEAR(slack.left, slack.right, 2 * kFitPixel) << seed;
    EXPECT_NEAR(slack.top, slack.bottom, 2 * kFitPixel) << seed;
  }
}

TEST_P(CameraFit, HoldsAllPointsBetweenNearAndFarPlane) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const FitCase made = random_fit(seed, GetParam());
    const Camera camera = make_camera(made.orbit, made.points, made.extent, made.insets);
    for (const vec3& p : made.points) {
      const float depth = camera.project(p).z;
      ASSERT_TRUE(depth > 0 && depth < 1) << seed << ": " << depth;
    }
  }
}

TEST_P(CameraFit, FillsThePictureWithATinyModelToo) {
  constexpr float kSize = 1e-3F;
  // The places of the points are rounded to 6e-8, 2e-4 of the model at most.
  constexpr float kTolerance = 0.5F;
  std::vector<vec3> points;
  for (const float x : {-kSize, kSize}) {
    for (const float y : {-kSize, kSize}) points.emplace_back(0.3F + x, 0.2F + y, 0.1F);
  }
  const Camera camera = make_camera({.orthographic = GetParam()}, points, {1280, 720});
  const Slack slack = slack_of(camera, points, {});
  EXPECT_NEAR(std::min(slack.horizontal(), slack.vertical()), 0, kTolerance);
}

TEST_P(CameraFit, ShowsTheSphereAtTheSameSizeFromEveryAzimuth) {
  const std::vector<vec3> points = {{0.3F, 0, 0}, {0, 0.9F, 0.1F}, {-0.2F, 0, -0.6F}};
  const Insets insets{.right = 100, .bottom = 40};
  Orbit orbit{.orthographic = GetParam(), .fit = Fit::kSphere};
  const Camera first = make_camera(orbit, points, {1280, 720}, insets);
  for (int turn = 0; turn < 24; ++turn) {
    orbit.azimuth = 15.0F * static_cast<float>(turn);
    const Camera camera = make_camera(orbit, points, {1280, 720}, insets);
    const vec3 top = camera.project({0, 0.9F, 0});
    EXPECT_NEAR(top.x, (1280 - 100) / 2.0F, kFitPixel);
    EXPECT_NEAR(top.y, first.project({0, 0.9F, 0}).y, kFitPixel);
    EXPECT_EQ(camera.projection, first.projection);
  }
}

TEST_P(CameraFit, TouchesTheRegionWithTheSphere) {
  const Insets insets{.left = 30, .top = 15, .right = 100, .bottom = 40};
  const Orbit orbit{.orthographic = GetParam(), .fit = Fit::kSphere};
  std::vector<vec3> sphere;
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  while (sphere.size() < 200000) {
    const vec3 p(normal(random), normal(random), normal(random));
    if (glm::length(p) > 0.01F) sphere.push_back(glm::normalize(p));
  }
  const Camera camera = make_camera(orbit, sphere, {1280, 720}, insets);
  const Slack slack = slack_of(camera, sphere, insets);
  // The nearest of the points to a sphere's outline is about 1e-5 of its size from it.
  EXPECT_NEAR(slack.top, 0, 0.1);
  EXPECT_NEAR(slack.bottom, 0, 0.1);
  EXPECT_NEAR(slack.left, slack.right, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Lenses, CameraFit, testing::Bool(), [](const auto& param_info) {
  return param_info.param ? "Orthographic" : "Perspective";
});

}  // namespace
}  // namespace geotherm::test
