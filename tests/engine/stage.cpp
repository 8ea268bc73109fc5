// SPDX-License-Identifier: MIT
#include "tests/engine/stage.h"

#include "engine/target.h"

namespace geotherm::test {

using namespace geotherm::engine;

Stage::Stage(const Device& on, Model shown, int samples)
    : device(on), model(std::move(shown)), renderer(must(Renderer::build(device, samples))) {
  must(renderer.set_surface(model.geometry()));
  scene.light = Light::kNone;
  look(kFromFront);
}

void Stage::look(const Orbit& orbit, glm::vec2 extent) {
  scene.camera = make_camera(orbit, model.positions, extent);
}

void Stage::paint(std::span<const float> values, float min, float max) {
  must(renderer.set_values(values));
  scene.surface.paint = Paint::kMap;
  scene.surface.range_min = min;
  scene.surface.range_max = max;
}

void Stage::draw_lines(std::span<const float> values, float spacing) {
  must(renderer.set_values(values));
  scene.surface.colour = glm::vec3(1);
  scene.surface.line_colour = glm::vec3(0);
  scene.surface.line_spacing = spacing;
}

Image Stage::draw(const Overlay& overlay) {
  return must(draw_picture(device, renderer, scene, overlay));
}

Image Stage::draw_into(glm::ivec2 extent, glm::ivec2 corner, const Overlay& overlay,
                       const PanelDraw* panels) {
  const auto target = must(OffscreenTarget::build(device, extent));
  target->set_origin(-corner);
  must(renderer.render(*target, scene, overlay, panels));
  Image image;
  image.width = extent.x;
  image.height = extent.y;
  image.pixels.resize(4 * static_cast<std::size_t>(extent.x) * static_cast<std::size_t>(extent.y));
  target->read(image, {0, 0}, extent);
  return image;
}

Stage full_stage(const Device& device, int samples) {
  Stage stage(device, model_of(sphere(3)), samples);
  stage.look({.azimuth = 30, .elevation = 20});
  stage.paint(stage.model.values([](const glm::vec3& p) { return 0.5F + 0.5F * p.y; }));
  stage.scene.light = Light::kThreePoint;
  stage.scene.surface.line_spacing = 0.1F;
  stage.scene.surface.wire = true;
  stage.scene.arrows.primary = true;
  std::vector<glm::vec3> field;
  for (const auto& face : stage.model.faces) {
    const glm::vec3& p = stage.model.positions[face[0]];
    field.push_back(glm::vec3(-p.z, 0, p.x));
  }
  must(stage.renderer.set_arrows(field, {}));
  const Marker marker{{0.5F, 0.5F, 0.7071F}, {0.6F, 0.4F, 0.69F}};
  must(stage.renderer.set_markers({&marker, 1}));
  const std::vector<glm::vec3> bend = {{-0.5F, 0.1F, 0.86F}, {0, 0.3F, 0.95F}, {0.4F, 0, 0.91F}};
  const Polyline line{bend, {0.9F, 0.8F, 0.1F}};
  must(stage.renderer.set_lines({&line, 1}));
  return stage;
}

Overlay some_text() {
  Overlay overlay;
  overlay.atlas = GlyphAtlas::build(20, {"tiles"});
  overlay.add_rectangle({10, 10}, {90, 40}, {0.5F, 0.5F, 0.5F, 0.5F});
  overlay.add_text({15, 30}, "tiles", {0, 0, 0, 1});
  return overlay;
}

}  // namespace geotherm::test
