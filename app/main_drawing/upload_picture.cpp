// SPDX-License-Identifier: MIT
#include "app/main_drawing/upload_picture.h"

#include "app/picture/picture_scale.h"
#include "engine/scene/colour_map.h"

namespace geotherm::app {

std::vector<glm::vec3> scene_vectors(const std::vector<PictureData::Vector>& all) {
  std::vector<glm::vec3> out;
  out.reserve(all.size());
  for (const auto& [x, y, z] : all) out.emplace_back(x, y, z);
  return out;
}

Result<void> upload_surface(engine::Renderer& renderer, const PictureData& data,
                            std::span<const glm::vec3> positions) {
  return renderer.set_surface({positions, data.faces, data.solid});
}

Result<void> upload_answer(engine::Renderer& renderer, const PictureData& data,
                           const PictureSettings& settings) {
  if (!data.values.empty()) {
    if (auto done = renderer.set_values(data.values); !done) return done;
  }
  if (const engine::ColourMap* map = engine::find_colour_map(colour_map_of(data, settings))) {
    const engine::ColourTable table = engine::colour_table(*map, settings.reverse);
    if (auto done = renderer.set_colours(table); !done) return done;
  }
  const auto arrows = renderer.set_arrows(scene_vectors(data.heat_directions),
                                          scene_vectors(data.distance_gradients));
  if (!arrows) return arrows;
  std::vector<engine::Marker> markers;
  for (const auto& [from, to] : data.sources) {
    markers.push_back({{from[0], from[1], from[2]}, {to[0], to[1], to[2]}});
  }
  return renderer.set_markers(markers);
}

Result<void> upload_picture(engine::Renderer& renderer, const PictureData& data,
                            const PictureSettings& settings, std::span<const glm::vec3> positions) {
  if (auto done = upload_surface(renderer, data, positions); !done) return done;
  return upload_answer(renderer, data, settings);
}

}  // namespace geotherm::app
