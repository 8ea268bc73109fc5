#version 460
// SPDX-License-Identifier: MIT
// The mesh: once for each vertex, with all that the fragment shader interpolates.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal_and_label;  // label: -1, 0 or 1, all three in each triangle
// Region: a place in the colours, -1: none; margin: see regions.glsl.
layout(location = 2) in vec3 value_region_margin;

layout(location = 3) in vec2 openness;  // of the normal's side, of the other one

layout(constant_id = 0) const uint features = 0;

// Few outputs: each costs a software device time in every triangle. xyz: the normal, or for flat
// shading the position, in eye space; w: the value, in spacings of isolines where there are any.
layout(location = 0) out vec4 eye_and_value;
layout(location = 1) out vec2 corner;  // two of the three barycentric coordinates
// For regions: margins and regions (and 1) of the three corners, each times its barycentric
// coordinate.
layout(location = 2) out vec3 corner_margins;
layout(location = 3) out vec3 corner_regions;
layout(location = 4) out vec2 open;

void main() {
  gl_Position = in_tile(frame.clip_from_scene * vec4(position, 1.0));
  if ((features & kFlat) != 0) {
    eye_and_value.xyz = (frame.eye_from_scene * vec4(position, 1.0)).xyz;
  } else {
    eye_and_value.xyz = mat3(frame.eye_from_scene) * normal_and_label.xyz;
  }
  if ((features & kForm) != 0) open = openness;
  float value = max(value_region_margin.x * frame.range.z, -1e38);
  eye_and_value.w = (features & (kMapped | kIsolines | kLevels)) != 0 ? value : 0.0;
  if ((features & (kWire | kRegions)) != 0) {
    corner = vec2(normal_and_label.w < -0.5, normal_and_label.w > 0.5);
  }
  if ((features & kRegions) != 0) {
    vec3 own = vec3(corner, 1.0 - corner.x - corner.y);
    corner_margins = own * value_region_margin.z;
    corner_regions = own * (value_region_margin.y + 1.0);
  }
}
