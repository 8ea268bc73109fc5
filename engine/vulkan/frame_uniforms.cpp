// SPDX-License-Identifier: MIT
#include "engine/vulkan/frame_uniforms.h"

#include <algorithm>
#include <cmath>

namespace geotherm::engine {

namespace {

/// Isolines closer than this share of the colours' range cannot be seen, and their numbers leave
/// what shaders compute with.
constexpr float kClosestLines = 1e-6F;

bool has_isolines(const SurfaceStyle& surface) {
  const float width = std::abs(surface.range_max - surface.range_min);
  const float reach = std::max({width, std::abs(surface.range_min), std::abs(surface.range_max)});
  return surface.line_spacing > kClosestLines * reach;
}

}  // namespace

shared::Frame frame_uniforms(const Scene& scene, glm::vec2 origin, glm::vec2 extent) {
  const SurfaceStyle& surface = scene.surface;
  const float width = surface.range_max - surface.range_min;
  shared::Frame frame{};
  frame.clip_from_scene = scene.camera.projection * scene.camera.view;
  frame.eye_from_scene = scene.camera.view;
  frame.extent = scene.camera.extent;
  frame.near_shift = 2;  // seen whole on surfaces inclined by up to 63 degrees
  const glm::vec2 magnified = scene.camera.extent / extent;
  frame.tile = {magnified, magnified - 2.0F * origin / extent - 1.0F};
  frame.orthographic = scene.camera.orthographic ? 1 : 0;
  const float per_width = width != 0 ? 1 / width : 0;
  const float scale = has_isolines(surface) ? 1 / surface.line_spacing : 1;
  frame.range = {per_width / scale, -surface.range_min * per_width, scale,
                 surface.scene_per_value / scale};
  frame.plain = {surface.colour, 1};
  frame.line = {surface.line_colour, surface.line_width * scene.pixel_scale};
  frame.wire = {surface.wire_colour, surface.wire_width * scene.pixel_scale};
  frame.marker = {scene.markers.colour, scene.markers.radius * scene.pixel_scale};
  frame.marker_rim = {scene.markers.rim, 1};
  const float half = 0.5F * scene.lines.width * scene.pixel_scale;
  frame.polyline = {half, half + scene.lines.rim * scene.pixel_scale, origin};
  return frame;
}

std::uint32_t surface_features(const Scene& scene) {
  const SurfaceStyle& surface = scene.surface;
  std::uint32_t features = 0;
  if (scene.light == Light::kNone) features |= shared::kNoLight;
  if (scene.light == Light::kThreePoint) features |= shared::kThreeLights;
  if (!surface.smooth && scene.light != Light::kNone) features |= shared::kFlat;
  if (surface.paint == Paint::kMap || surface.paint == Paint::kFaces) features |= shared::kMapped;
  if (surface.paint == Paint::kRegions) features |= shared::kRegions;
  if (has_isolines(surface)) features |= shared::kIsolines;
  if (surface.wire) features |= shared::kWire;
  return features;
}

}  // namespace geotherm::engine
