// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "shaders/shared.h"

namespace geotherm::engine {

/// A scene as the shaders read it.
shared::Frame frame_uniforms(const Scene& scene);

/// The features (shared.h) that the surface needs: what is off is not compiled in.
std::uint32_t surface_features(const Scene& scene);

}  // namespace geotherm::engine
