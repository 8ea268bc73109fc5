// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include <span>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "engine/scene/camera.h"

// The eye of a picture.
namespace geotherm::app {

/// What the eye sees of `points`, which lie in scene space and belong to `data`.
engine::Camera camera_of(const PictureData& data, const CameraSettings& camera,
                         std::span<const glm::vec3> points, glm::vec2 extent,
                         const engine::Insets& insets);

/// The same camera without a centre of its own, zoomed and moved until what it sees of `points`
/// fills the room that the insets leave. Precondition: there are points.
CameraSettings tight_camera(const PictureData& data, CameraSettings camera,
                            std::span<const glm::vec3> points, glm::vec2 extent,
                            const engine::Insets& insets);

/// Where the camera's axis meets the picture without a pan, pixels: what zooming scales about.
glm::vec2 lens_centre(glm::vec2 extent, const engine::Insets& insets);

}  // namespace geotherm::app
