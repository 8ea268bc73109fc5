// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

#include "app/picture/drawing.h"
#include "app/picture/picture_data.h"
#include "app/picture/picture_scale.h"
#include "app/picture/picture_settings.h"
#include "engine/device.h"
#include "engine/overlay/overlay.h"
#include "engine/renderer.h"
#include "engine/scene/scene.h"

// A picture's data and settings as the engine takes them.
namespace geotherm::app {

DrawingDevice to_drawing_device(const engine::DeviceInfo& info);

engine::Legend legend_of(const PictureData& data, const PictureSettings& settings,
                         const PictureScale& scale);

/// A line of text is so much higher than the size its font is called by.
inline constexpr double kLineOfEm = 1.164;

/// The room that the legend is given beside the model. Where the model is to look as large from
/// everywhere (PictureFit::kSphere) that follows from settings alone, so that it does not move when
/// a bar or a caption comes or goes; else it is what this legend takes. Cost there: lay_out().
engine::Insets insets_of(const PictureSettings& settings, const engine::LegendLayout& legend,
                         glm::vec2 extent);

/// All of the scene but its camera.
engine::Scene scene_of(const PictureData& data, const PictureSettings& settings,
                       const PictureScale& scale);

/// Each vertex' place in engine::region_table(), -1 where no source is. Precondition:
/// shows_regions().
std::vector<std::int32_t> region_places(const PictureData& data);
/// And its margin there (engine/scene/region_margins.h).
std::vector<float> region_margins_of(const PictureData& data);

/// The settings' map in as many colours as they ask for: bars and files read it anywhere, the
/// shader of surfaces in the middle of a band alone, whose borders are those of the values there.
engine::ColourTable colours_of(const engine::ColourMap& map, const PictureDataSettings& settings);

/// The sources.
std::vector<engine::Marker> scene_markers(const PictureData& data);

std::vector<glm::vec3> scene_vectors(const std::vector<PictureData::Vector>& all);

std::vector<engine::Openness> scene_openness(const PictureData& data);

/// Hands a renderer the mesh. `positions`: those of the data. Errors: the renderer's.
Result<void> upload_surface(engine::Renderer& renderer, const PictureData& data,
                            std::span<const glm::vec3> positions);

/// Hands it all else that a picture is drawn from: values, regions, arrows, lines, markers,
/// colours; what the data lack is taken away. Precondition: upload_surface(). Errors: the
/// renderer's.
Result<void> upload_answer(engine::Renderer& renderer, const PictureData& data,
                           const PictureDataSettings& settings);

/// Both.
Result<void> upload_picture(engine::Renderer& renderer, const PictureData& data,
                            const PictureDataSettings& settings,
                            std::span<const glm::vec3> positions);

}  // namespace geotherm::app
