// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "engine/target.h"
#include "tests/engine/models.h"

// What a picture shows, in numbers.
namespace geotherm::test {

/// Pixels from `min` up to, without, `max`.
struct Box {
  glm::ivec2 min, max;
  int area() const { return (max.x - min.x) * (max.y - min.y); }
};
/// All of it but a border.
Box inner(const engine::Image& image, int border = 0);

/// 0 to 1.
glm::vec3 colour_at(const engine::Image& image, int x, int y);
inline glm::vec3 colour_at(const engine::Image& image, const glm::vec3& pixel) {
  return colour_at(image, static_cast<int>(pixel.x), static_cast<int>(pixel.y));
}
/// 0: white, 1: black; the mean of the three channels.
double darkness(const engine::Image& image, int x, int y);
/// The largest difference of a channel, 0 to 1.
float difference(const glm::vec3& a, const glm::vec3& b);

struct Moments {
  double mean = 0, deviation = 0;
};
Moments darkness_in(const engine::Image& image, const Box& box);

/// Dark runs along a line of pixels from `from` in steps of `step`: the centre of each, weighted by
/// darkness, in pixels from the middle of the first one, and the sum of its darkness.
struct Run {
  double centre = 0, darkness = 0;
};
std::vector<Run> dark_runs(const engine::Image& image, glm::ivec2 from, glm::ivec2 step, int count);

/// Share of the pixels with a channel (alpha included) that differs by more than `tolerance` of
/// 255.
double different_pixels(const engine::Image& a, const engine::Image& b, int tolerance);

/// What the eye sees through the middle of a pixel.
struct Hit {
  std::size_t face = 0;
  glm::dvec3 weights;  ///< of its corners
};
std::optional<Hit> hit(const Model& model, const engine::Camera& camera, int x, int y);
/// Between the corners of the face that was hit.
double value_at(const Model& model, std::span<const float> values, const Hit& hit);

}  // namespace geotherm::test
