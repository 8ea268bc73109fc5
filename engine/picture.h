// SPDX-License-Identifier: MIT
#pragma once

#include "engine/image.h"
#include "engine/renderer.h"

namespace geotherm::engine {

/// Draws a picture of scene.camera.extent pixels into memory, in tiles where it is larger than
/// `largest_tile` (0: a size that suits) or than the device can draw at once. Errors: kBadInput (a
/// size that is not
/// between 1 and 16384), the renderer's.
Result<Image> draw_picture(const Device& device, Renderer& renderer, const Scene& scene,
                           const Overlay& overlay = {}, int largest_tile = 0);

}  // namespace geotherm::engine
