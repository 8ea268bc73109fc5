// SPDX-License-Identifier: MIT
#include "app/main_drawing/upload_picture.h"

#include "app/picture/picture_scale.h"
#include "engine/scene/colours.h"

namespace geotherm::app {
namespace {

/// The colours of a view, and what they stand for where that is no value.
Result<void> upload_colours(engine::Renderer& renderer, const PictureData& data,
                            const PictureSettings& settings) {
  if (shows_regions(data, settings)) {
    const auto places = engine::region_colour_places(data.faces, data.nearest);
    if (auto done = renderer.set_regions(places); !done) return done;
    return renderer.set_colours(engine::region_table());
  }
  if (auto done = renderer.set_regions({}); !done) return done;
  const engine::ColourMap* map = engine::find_colour_map(colour_map_of(data, settings));
  return map == nullptr ? Result<void>()
                        : renderer.set_colours(engine::colour_table(*map, settings.reverse));
}

Result<void> upload_lines(engine::Renderer& renderer, const PictureData& data) {
  std::vector<std::vector<glm::vec3>> points;
  points.reserve(data.lines.size());
  std::vector<engine::Polyline> lines;
  for (const PictureData::Line& line : data.lines) {
    points.push_back(scene_vectors(line.points));
    lines.push_back({points.back(), {line.colour[0], line.colour[1], line.colour[2]}});
  }
  return renderer.set_lines(lines);
}

}  // namespace

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
  if (auto done = renderer.set_face_values(data.face_values); !done) return done;
  if (auto done = upload_colours(renderer, data, settings); !done) return done;
  if (auto done = upload_lines(renderer, data); !done) return done;
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
