// SPDX-License-Identifier: MIT
#include "tests/engine/stage.h"

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

}  // namespace geotherm::test
