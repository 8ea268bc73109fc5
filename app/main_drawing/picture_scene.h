// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "app/picture/picture_scale.h"
#include "engine/overlay/overlay.h"
#include "engine/scene/scene.h"

// Settings of a picture in the engine's words.
namespace geotherm::app {

engine::Legend legend_of(const PictureData& data, const PictureSettings& settings,
                         const PictureScale& scale);

/// What the eye sees of `points`, which lie in scene space and belong to `data`.
engine::Camera camera_of(const PictureData& data, const CameraSettings& camera,
                         std::span<const glm::vec3> points, glm::vec2 extent,
                         const engine::Insets& insets);

/// Where the camera's axis meets the picture without a pan, pixels: what zooming scales about.
glm::vec2 lens_centre(glm::vec2 extent, const engine::Insets& insets);

/// All of the scene but its camera.
engine::Scene scene_of(const PictureData& data, const PictureSettings& settings,
                       const PictureScale& scale);

}  // namespace geotherm::app
