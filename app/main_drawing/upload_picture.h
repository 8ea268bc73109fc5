// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "engine/renderer.h"

namespace geotherm::app {

std::vector<glm::vec3> scene_vectors(const std::vector<PictureData::Vector>& all);

/// Hands a renderer the mesh. `positions`: those of the data. Errors: the renderer's.
Result<void> upload_surface(engine::Renderer& renderer, const PictureData& data,
                            std::span<const glm::vec3> positions);

/// Hands it all else that a picture is drawn from: values, regions, arrows, lines, markers,
/// colours; what the data lack is taken away. Precondition: upload_surface(). Errors: the
/// renderer's.
Result<void> upload_answer(engine::Renderer& renderer, const PictureData& data,
                           const PictureSettings& settings);

/// Both.
Result<void> upload_picture(engine::Renderer& renderer, const PictureData& data,
                            const PictureSettings& settings, std::span<const glm::vec3> positions);

}  // namespace geotherm::app
