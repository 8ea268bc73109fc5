// SPDX-License-Identifier: MIT
#include "tests/engine/measure.h"

#include <algorithm>
#include <cmath>

namespace geotherm::test {

using engine::Image;

Box inner(const Image& image, int border) {
  return {{border, border}, {image.width - border, image.height - border}};
}

glm::vec3 colour_at(const Image& image, int x, int y) {
  const std::uint8_t* const p = image.at(x, y);
  return glm::vec3(p[0], p[1], p[2]) / 255.0F;
}

double darkness(const Image& image, int x, int y) {
  const std::uint8_t* const p = image.at(x, y);
  return 1 - (p[0] + p[1] + p[2]) / (3 * 255.0);
}

float difference(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = glm::abs(a - b);
  return std::max({d.r, d.g, d.b});
}

Moments darkness_in(const Image& image, const Box& box) {
  double sum = 0;
  double squares = 0;
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const double d = darkness(image, x, y);
      sum += d;
      squares += d * d;
    }
  }
  const double mean = sum / box.area();
  return {mean, std::sqrt(std::max(0.0, squares / box.area() - mean * mean))};
}

std::vector<Run> dark_runs(const Image& image, glm::ivec2 from, glm::ivec2 step, int count) {
  constexpr double kDark = 0.02;
  std::vector<Run> runs;
  bool inside = false;
  for (int i = 0; i < count; ++i) {
    const glm::ivec2 at = from + i * step;
    const double d = darkness(image, at.x, at.y);
    if (d > kDark) {
      if (!inside) runs.emplace_back();
      runs.back().darkness += d;
      runs.back().centre += d * i;
    }
    inside = d > kDark;
  }
  for (Run& run : runs) run.centre /= run.darkness;
  return runs;
}

double different_pixels(const Image& a, const Image& b, int tolerance) {
  if (a.width != b.width || a.height != b.height) return 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    bool differs = false;
    for (std::size_t k = i; k < i + 4; ++k) {
      differs |= std::abs(int{a.pixels[k]} - int{b.pixels[k]}) > tolerance;
    }
    count += differs;
  }
  return 4.0 * static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

namespace {

/// Weights of the corners where a line meets the plane of a triangle, if it does so within it.
std::optional<glm::dvec3> weights_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                     const glm::dvec3& from, const glm::dvec3& way, double& along) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double slope = glm::dot(normal, way);
  if (slope == 0) return std::nullopt;
  along = glm::dot(normal, a - from) / slope;
  const glm::dvec3 p = from + along * way;
  const auto part = [&](const glm::dvec3& u, const glm::dvec3& v) {
    return glm::dot(glm::cross(u - p, v - p), normal) / glm::dot(normal, normal);
  };
  const glm::dvec3 weights(part(b, c), part(c, a), part(a, b));
  if (weights.x < 0 || weights.y < 0 || weights.z < 0) return std::nullopt;
  return weights;
}

}  // namespace

std::optional<Hit> hit(const Model& model, const engine::Camera& camera, int x, int y) {
  const glm::dmat4 scene_from_clip =
      glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
  const auto at = [&](double depth) {
    const glm::dvec2 clip((x + 0.5) / camera.extent.x * 2 - 1, (y + 0.5) / camera.extent.y * 2 - 1);
    const glm::dvec4 p = scene_from_clip * glm::dvec4(clip, depth, 1);
    return glm::dvec3(p) / p.w;
  };
  const glm::dvec3 near = at(1);
  const glm::dvec3 far = at(0);
  std::optional<Hit> first;
  double nearest = 1;
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    const auto& [a, b, c] = model.faces[f];
    double along = 0;
    const auto weights = weights_of(model.positions[a], model.positions[b], model.positions[c],
                                    near, far - near, along);
    if (!weights || along < 0 || along > nearest) continue;
    nearest = along;
    first = Hit{f, *weights};
  }
  return first;
}

double value_at(const Model& model, std::span<const float> values, const Hit& hit) {
  double value = 0;
  for (int k = 0; k < 3; ++k) {
    value += hit.weights[k] * values[model.faces[hit.face][static_cast<std::size_t>(k)]];
  }
  return value;
}

}  // namespace geotherm::test
