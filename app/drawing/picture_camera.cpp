// SPDX-License-Identifier: MIT
#include "app/drawing/picture_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace geotherm::app {
namespace {

/// Between the model and the sides of the picture, of the smaller of them.
constexpr float kMargin = 0.03F;

/// Room for what is wider than the model: markers, arrow heads, the smooth edge itself.
engine::Insets with_margin(glm::vec2 extent, const engine::Insets& insets) {
  const float margin = kMargin * std::min(extent.x, extent.y);
  return {std::max(insets.left, margin), std::max(insets.top, margin),
          std::max(insets.right, margin), std::max(insets.bottom, margin)};
}

/// A point far outside the model is of no use in its middle.
glm::vec3 scene_centre(const PictureData& data, const std::array<double, 3>& centre) {
  constexpr double kFarthest = 100;
  glm::vec3 out(0);
  for (int k = 0; k < 3; ++k) {
    const double x = (centre[static_cast<std::size_t>(k)] - data.centre[k]) / data.model_per_scene;
    out[k] = static_cast<float>(std::clamp(x, -kFarthest, kFarthest));
  }
  return out;
}

}  // namespace

engine::Camera camera_of(const PictureData& data, const CameraSettings& camera,
                         std::span<const glm::vec3> points, glm::vec2 extent,
                         const engine::Insets& insets) {
  engine::Orbit orbit;
  orbit.azimuth = static_cast<float>(camera.azimuth);
  orbit.elevation = static_cast<float>(camera.elevation);
  orbit.zoom = static_cast<float>(camera.zoom);
  orbit.pan = {static_cast<float>(camera.pan_right), static_cast<float>(camera.pan_up)};
  orbit.orthographic = camera.orthographic;
  orbit.fit = camera.fit == PictureFit::kSphere ? engine::Fit::kSphere : engine::Fit::kTight;
  const auto axes = axes_of(camera.up == UpAxis::kAuto ? data.up : camera.up);
  for (int k = 0; k < 3; ++k) {
    const auto& [x, y, z] = axes[static_cast<std::size_t>(k)];
    orbit.axes[k] = {x, y, z};
  }
  orbit.roll = static_cast<float>(camera.roll);
  if (camera.centre) orbit.centre = scene_centre(data, *camera.centre);
  return engine::make_camera(orbit, points, extent, with_margin(extent, insets));
}

CameraSettings tight_camera(const PictureData& data, CameraSettings camera,
                            std::span<const glm::vec3> points, glm::vec2 extent,
                            const engine::Insets& insets) {
  camera.zoom = 1;
  camera.pan_right = camera.pan_up = 0;
  camera.centre.reset();
  const engine::Camera seen = camera_of(data, camera, points, extent, insets);
  glm::vec2 low(std::numeric_limits<float>::max()), high(-low);
  for (const glm::vec3& point : points) {
    const glm::vec2 at(seen.project(point));
    if (!std::isfinite(at.x + at.y)) continue;
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const engine::Insets padded = with_margin(extent, insets);
  const glm::vec2 room = extent - glm::vec2(padded.left + padded.right, padded.top + padded.bottom);
  const glm::vec2 zooms = room / glm::max(high - low, glm::vec2(1e-3F));
  const float zoom = std::min(zooms.x, zooms.y);
  if (!std::isfinite(zoom) || zoom <= 0) return camera;
  // A zoom scales about the middle of the room, where the middle of the model is to be.
  const glm::vec2 off = zoom * ((low + high) / 2.0F - lens_centre(extent, insets)) / extent.y;
  camera.zoom = zoom;
  camera.pan_right = -off.x;
  camera.pan_up = off.y;
  return camera;
}

glm::vec2 lens_centre(glm::vec2 extent, const engine::Insets& insets) {
  const engine::Insets padded = with_margin(extent, insets);
  return {(padded.left + extent.x - padded.right) / 2, (padded.top + extent.y - padded.bottom) / 2};
}

}  // namespace geotherm::app
