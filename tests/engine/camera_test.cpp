// SPDX-License-Identifier: MIT
#include "engine/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace geotherm::test {
namespace {

using engine::Camera;
using engine::Fit;
using engine::Insets;
using engine::make_camera;
using engine::Orbit;
using glm::vec2;
using glm::vec3;

constexpr vec2 kExtent(1280, 720);
/// Pixels by which single precision may be off in a picture of this size.
constexpr float kPixel = 0.01F;

const std::vector<vec3> kOctahedron = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                       {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};

Camera sphere_camera(float azimuth, float elevation, bool orthographic = false) {
  return make_camera({.azimuth = azimuth,
                      .elevation = elevation,
                      .orthographic = orthographic,
                      .fit = Fit::kSphere},
                     kOctahedron, kExtent);
}

void expect_pixel(const Camera& camera, const vec3& point, vec2 away) {
  const vec2 middle = vec2(camera.project({0, 0, 0}));
  const vec2 seen = vec2(camera.project(point)) - middle;
  EXPECT_LE(glm::length(glm::normalize(seen) - away), 1e-4F) << seen.x << " " << seen.y;
}

void expect_near(const vec3& a, const vec3& b, float tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

void expect_sane(const Camera& camera) {
  const vec3 centre = camera.project({0, 0, 0});
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(centre[i])) << i;
  EXPECT_GE(centre.z, 0);
  EXPECT_LE(centre.z, 1);
  EXPECT_GT(camera.pixels_per_unit, 0);
  EXPECT_TRUE(std::isfinite(camera.pixels_per_unit));
  EXPECT_NEAR(glm::determinant(glm::mat3(camera.view)), 1, 1e-5);
}

TEST(Camera, LooksFromPlusZAtAzimuthZero) {
  const Camera camera = sphere_camera(0, 0, true);
  expect_near(camera.to_eye({0, 0, 0}), {0, 0, 1}, 1e-6F);
  EXPECT_GT(camera.project({1, 0, 0}).x, kExtent.x / 2);  // +X is to the right
  EXPECT_LT(camera.project({0, 1, 0}).y, kExtent.y / 2);  // +Y is up, pixels count down
}

TEST(Camera, LooksFromPlusXAtAzimuthNinety) {
  const Camera camera = sphere_camera(90, 0, true);
  expect_near(camera.to_eye({0, 0, 0}), {1, 0, 0}, 1e-6F);
  EXPECT_LT(camera.project({0, 0, 1}).x, kExtent.x / 2);
}

TEST(Camera, LooksFromAboveAtPositiveElevation) {
  const Camera camera = sphere_camera(30, 40);
  const vec3 eye = camera.to_eye({0, 0, 0});
  EXPECT_NEAR(eye.y, std::sin(glm::radians(40.0F)), 1e-6);
  EXPECT_NEAR(std::atan2(eye.x, eye.z), glm::radians(30.0F), 1e-6);
}

TEST(Camera, KeepsItsAzimuthAtThePoles) {
  for (const float pole : {-90.0F, 90.0F, 1000.0F}) {
    const Camera camera = sphere_camera(90, pole);
    expect_sane(camera);
    expect_near(camera.to_eye({0, 0, 0}), {0, pole < 0 ? -1 : 1, 0}, 1e-6F);
    EXPECT_LT(camera.project({0, 0, 1}).x, kExtent.x / 2 - 100) << pole;
  }
}

TEST(Camera, HasDepthOneAtTheNearAndZeroAtTheFarPlane) {
  for (const bool orthographic : {false, true}) {
    const Camera camera = sphere_camera(0, 0, orthographic);
    const float front = camera.project({0, 0, 1}).z;
    const float back = camera.project({0, 0, -1}).z;
    EXPECT_GT(front, camera.project({0, 0, 0}).z);
    EXPECT_GT(camera.project({0, 0, 0}).z, back);
    EXPECT_LE(front, 1);
    EXPECT_GE(back, 0);
    EXPECT_GT(front, 0.9F);
    EXPECT_LT(back, 0.1F);
  }
}

TEST(Camera, HoldsTheUnitSphereBetweenItsPlanesForASmallModelToo) {
  for (const bool orthographic : {false, true}) {
    const std::vector<vec3> speck = {{0.9F, 0, 0}, {0.91F, 0.01F, 0}, {0.9F, 0, 0.01F}};
    const Camera camera = make_camera({.orthographic = orthographic}, speck, kExtent);
    for (const vec3& p : speck) {
      EXPECT_GT(camera.project(p).z, 0);
      EXPECT_LT(camera.project(p).z, 1);
    }
    EXPECT_GE(camera.project(-camera.to_eye({0, 0, 0})).z, 0);
  }
}

TEST(Camera, SaysHowManyPixelsALengthCovers) {
  for (const bool orthographic : {false, true}) {
    const Camera camera = sphere_camera(0, 0, orthographic);
    const float depth = -(camera.view * glm::vec4(0, 0, 0, 1)).z;
    const float pixels = camera.pixels_per_unit / (orthographic ? 1 : depth);
    const float seen = camera.project({0.5F, 0, 0}).x - camera.project({-0.5F, 0, 0}).x;
    EXPECT_NEAR(seen, pixels, kPixel);
  }
}

TEST(Camera, ZoomsAboutTheCentreOfWhatTheInsetsLeave) {
  const Insets insets{.left = 10, .top = 20, .right = 200, .bottom = 60};
  const vec2 centre((10 + 1280 - 200) / 2.0F, (20 + 720 - 60) / 2.0F);
  for (const bool orthographic : {false, true}) {
    const Orbit once{.orthographic = orthographic};
    Orbit thrice = once;
    thrice.zoom = 3;
    const Camera before = make_camera(once, kOctahedron, kExtent, insets);
    const Camera after = make_camera(thrice, kOctahedron, kExtent, insets);
    for (const vec3& p : kOctahedron) {
      const vec2 expected = centre + 3.0F * (vec2(before.project(p)) - centre);
      EXPECT_LE(glm::length(vec2(after.project(p)) - expected), 5 * kPixel);
    }
  }
}

TEST(Camera, PansByPictureHeightsAtAnyZoom) {
  for (const float zoom : {1.0F, 7.0F}) {
    const Camera before = make_camera({.zoom = zoom}, kOctahedron, kExtent);
    const Camera after = make_camera({.zoom = zoom, .pan = {0.25F, 0.5F}}, kOctahedron, kExtent);
    for (const vec3& p : kOctahedron) {
      const vec2 shift = vec2(after.project(p)) - vec2(before.project(p));
      EXPECT_LE(glm::length(shift - vec2(180, -360)), 5 * kPixel) << zoom;
    }
  }
}

TEST(Camera, LeavesOutPointsThatAreNotFinite) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<vec3> points = kOctahedron;
  points.emplace_back(kNan, 0, 0);
  points.emplace_back(0, std::numeric_limits<float>::infinity(), 0);
  const Camera with = make_camera({}, points, kExtent);
  const Camera without = make_camera({}, kOctahedron, kExtent);
  EXPECT_EQ(with.view, without.view);
  EXPECT_EQ(with.projection, without.projection);
}

TEST(Camera, IsSaneWithoutAnyShape) {
  const std::vector<std::vector<vec3>> clouds = {
      {}, {{0.2F, -0.3F, 0.4F}}, {{0, 0, 0}, {0, 0, 0}}, {{0, 0, -1}, {0, 0, 1}}};
  for (const auto& points : clouds) {
    for (const bool orthographic : {false, true}) {
      for (const Fit fit : {Fit::kTight, Fit::kSphere}) {
        const Camera camera =
            make_camera({.azimuth = 0, .elevation = 0, .orthographic = orthographic, .fit = fit},
                        points, kExtent);
        expect_sane(camera);
        for (const vec3& p : points) {
          const vec3 seen = camera.project(p);
          EXPECT_TRUE(seen.z > 0 && seen.z < 1) << points.size() << " " << seen.z;
          EXPECT_TRUE(seen.x >= 0 && seen.x <= kExtent.x);
          EXPECT_TRUE(seen.y >= 0 && seen.y <= kExtent.y);
        }
      }
    }
  }
}

TEST(Camera, IsSaneForNumbersThatAreNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Orbit orbit{
      .azimuth = kNan, .elevation = kNan, .zoom = kNan, .pan = {kNan, kNan}, .field_of_view = kNan};
  expect_sane(make_camera(orbit, kOctahedron, {kNan, 0}, {kNan, kNan, 1e9F, -5}));
  expect_sane(make_camera({.zoom = 0}, kOctahedron, kExtent));
  expect_sane(make_camera({.field_of_view = 1e9F}, kOctahedron, kExtent));
  expect_sane(make_camera({.field_of_view = -3}, kOctahedron, kExtent));
}

TEST(Camera, IsSaneWhenInsetsLeaveNothing) {
  const Camera camera = make_camera({}, kOctahedron, {100, 50}, {80, 90, 80, 90});
  expect_sane(camera);
  for (const vec3& p : kOctahedron) {
    const vec3 seen = camera.project(p);
    EXPECT_TRUE(seen.x > 0 && seen.x < 100 && seen.y > 0 && seen.y < 50);
  }
}

TEST(Camera, PointsToTheEyeFromEachPoint) {
  const Camera camera = sphere_camera(30, 20);
  const vec3 a(0.5F, 0.1F, -0.2F);
  const vec3 b = a + 0.7F * camera.to_eye(a);  // on the way to the eye: the same pixel
  EXPECT_LE(glm::length(vec2(camera.project(a)) - vec2(camera.project(b))), kPixel);
  EXPECT_GT(camera.project(b).z, camera.project(a).z);
}

TEST(CameraRoll, TurnsThePictureCounterClockwise) {
  Orbit orbit{.azimuth = 0, .elevation = 0, .orthographic = true, .fit = Fit::kSphere};
  orbit.roll = 90;
  const Camera camera = make_camera(orbit, kOctahedron, kExtent);
  expect_pixel(camera, {1, 0, 0}, {0, -1});  // to the right is up now; pixels count downwards
  expect_pixel(camera, {0, 1, 0}, {-1, 0});
}

TEST(CameraAxes, TakeThePlacesOfRightUpAndEye) {
  Orbit orbit{.azimuth = 0, .elevation = 0, .orthographic = true, .fit = Fit::kSphere};
  orbit.axes = glm::mat3(vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, -1, 0));  // Z is up
  const Camera camera = make_camera(orbit, kOctahedron, kExtent);
  expect_pixel(camera, {1, 0, 0}, {1, 0});
  expect_pixel(camera, {0, 0, 1}, {0, -1});
  EXPECT_GT(camera.project({0, -1, 0}).z, camera.project({0, 1, 0}).z) << "the eye is at -Y";
}

}  // namespace
}  // namespace geotherm::test
