// SPDX-License-Identifier: MIT
#pragma once

#include "engine/renderer.h"
#include "tests/engine/gpu_fixture.h"
#include "tests/engine/models.h"

namespace geotherm::test {

inline constexpr glm::vec2 kSmallPicture(320, 240);

/// Straight from +Z without perspective.
inline constexpr engine::Orbit kFromFront{.azimuth = 0, .elevation = 0, .orthographic = true};

/// A model that is ready to be drawn. The scene begins as simple as can be: seen from the front,
/// unlit, on white, one sample a pixel.
class Stage {
 public:
  Stage(const engine::Device& device, Model model, int samples = 1);

  void look(const engine::Orbit& orbit, glm::vec2 extent = kSmallPicture);
  /// Painted by these values, the map from `min` to `max`.
  void paint(std::span<const float> values, float min = 0, float max = 1);
  /// Isolines of these values, black on white.
  void draw_lines(std::span<const float> values, float spacing);

  engine::Image draw(const engine::Overlay& overlay = {});
  /// The picture with its first pixel at `corner` of a target that may be larger than it.
  engine::Image draw_into(glm::ivec2 extent, glm::ivec2 corner, const engine::Overlay& overlay = {},
                          const engine::PanelDraw* panels = nullptr);

  const engine::Device& device;
  Model model;
  engine::Renderer renderer;
  engine::Scene scene;
};

/// Something of everything: values, isolines, edges, arrows, a line, a source, on a sphere.
Stage full_stage(const engine::Device& device, int samples = 4);
engine::Overlay some_text();

}  // namespace geotherm::test
