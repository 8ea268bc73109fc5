// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "engine/scene/scene.h"
#include "shaders/shared.h"

namespace geotherm::engine {

/// A scene as the shaders read it. `origin`, `extent`: the part of the picture that is drawn,
/// pixels.
shared::Frame frame_uniforms(const Scene& scene, glm::vec2 origin, glm::vec2 extent);

/// The features (shared.h) that the surface needs: what is off is not compiled in.
std::uint32_t surface_features(const Scene& scene);

}  // namespace geotherm::engine
