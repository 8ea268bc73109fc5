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

using namespace geotherm::engine;
using glm::vec2;
using glm::vec3;

constexpr float kCentrePixel = 0.02F;  // what rounding of the matrices may move a point
const vec2 kCentreExtent(1280, 720);

struct Case {
  std::vector<vec3> points;  ///< within radius 1, as all models
  Orbit orbit;
};

vec3 within_radius_1(std::mt19937& random) {
  std::uniform_real_distribution<float> side(-1, 1);
  while (true) {
    const vec3 p(side(random), side(random), side(random));
    if (glm::length(p) <= 1) return p;
  }
}

Case random_case(unsigned seed, bool orthographic) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0, 1);
  Case made;
  for (int i = 0; i < 100; ++i) made.points.push_back(within_radius_1(random));
  made.orbit.azimuth = 360 * share(random);
  made.orbit.elevation = 180 * share(random) - 90;
  made.orbit.field_of_view = 5 + 140 * share(random);
  made.orbit.orthographic = orthographic;
  made.orbit.fit = Fit::kSphere;
  made.orbit.centre = within_radius_1(random);
  return made;
}

class OrbitCentre : public testing::TestWithParam<bool> {};  // orthographic or not

TEST_P(OrbitCentre, LiesInTheMiddleOfWhatTheInsetsLeave) {
  const Insets insets{.left = 10, .top = 20, .right = 200, .bottom = 60};
  const vec2 middle((10 + 1280 - 200) / 2.0F, (20 + 720 - 60) / 2.0F);
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Case made = random_case(seed, GetParam());
    const Camera camera = make_camera(made.orbit, made.points, kCentreExtent, insets);
    const vec3 seen = camera.project(made.orbit.centre);
    EXPECT_LE(glm::length(vec2(seen) - middle), kCentrePixel) << seed;
  }
}

TEST_P(OrbitCentre, LeavesAllPointsBetweenNearAndFarPlane) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Case made = random_case(seed, GetParam());
    const Camera camera = make_camera(made.orbit, made.points, kCentreExtent);
    for (const vec3& p : made.points) {
      const glm::vec4 clip = camera.projection * (camera.view * glm::vec4(p, 1));
      ASSERT_GT(clip.w, 0) << seed;
      ASSERT_GT(clip.z / clip.w, 0) << seed;
      ASSERT_LT(clip.z / clip.w, 1) << seed;
    }
  }
}

/// The circle that a sphere of radius 1 about the centre shows as touches the upper and lower side
/// of the region.
TEST_P(OrbitCentre, HasASphereOfRadius1AboutItThatFits) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Case made = random_case(seed, GetParam());
    const Camera camera = make_camera(made.orbit, made.points, kCentreExtent);
    const float depth = -(camera.view * glm::vec4(made.orbit.centre, 1)).z;
    // The tangent of the angle under which the eye sees it, or its radius.
    const float half = GetParam() ? 1 : 1 / std::sqrt(depth * depth - 1);
    EXPECT_NEAR(camera.pixels_per_unit * half, kCentreExtent.y / 2, 0.2F) << seed;
  }
}

TEST_P(OrbitCentre, AtTheOriginIsTheSphereOfTheModel) {
  Case made = random_case(3, GetParam());
  made.orbit.centre = vec3(0);
  const Camera camera = make_camera(made.orbit, made.points, kCentreExtent);
  const Camera without = make_camera(made.orbit, {}, kCentreExtent);
  EXPECT_EQ(camera.view, without.view);
  EXPECT_EQ(camera.pixels_per_unit, without.pixels_per_unit);
}

TEST_P(OrbitCentre, MeansNothingToATightFit) {
  Case made = random_case(5, GetParam());
  made.orbit.fit = Fit::kTight;
  const Camera with = make_camera(made.orbit, made.points, kCentreExtent);
  made.orbit.centre = vec3(0);
  const Camera without = make_camera(made.orbit, made.points, kCentreExtent);
  EXPECT_EQ(with.view, without.view);
  EXPECT_EQ(with.projection, without.projection);
}

TEST_P(OrbitCentre, ThatIsNoPointIsTheOrigin) {
  Case made = random_case(7, GetParam());
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    made.orbit.centre = {0.5F, bad, 0};
    const Camera with = make_camera(made.orbit, made.points, kCentreExtent);
    made.orbit.centre = vec3(0);
    EXPECT_EQ(with.view, make_camera(made.orbit, made.points, kCentreExtent).view);
  }
}

TEST_P(OrbitCentre, ZoomsAndPansAboutItself) {
  Case made = random_case(9, GetParam());
  made.orbit.zoom = 4;
  made.orbit.pan = {0.25F, 0.125F};
  const Camera camera = make_camera(made.orbit, made.points, kCentreExtent);
  const vec3 seen = camera.project(made.orbit.centre);
  EXPECT_LE(glm::length(vec2(seen) - vec2(640 + 180, 360 - 90)), 4 * kCentrePixel);
}

INSTANTIATE_TEST_SUITE_P(Lenses, OrbitCentre, testing::Bool(), [](const auto& param_info) {
  return param_info.param ? "Orthographic" : "Perspective";
});

}  // namespace
}  // namespace geotherm::test
