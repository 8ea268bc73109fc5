#version 460
// SPDX-License-Identifier: MIT
// The mesh: once for each vertex, with all that the fragment shader interpolates.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal_and_label;  // label: -1, 0 or 1, all three in each triangle
layout(location = 2) in float value;

layout(constant_id = 0) const uint features = 0;

layout(location = 0) out vec3 eye_normal;
layout(location = 1) out vec3 eye_position;
layout(location = 2) out float out_value;
layout(location = 3) out vec2 corner;  // two of the three barycentric coordinates

void main() {
  gl_Position = frame.clip_from_scene * vec4(position, 1.0);
  if ((features & kNoLight) == 0) {
    if ((features & kFlat) != 0) {
      eye_position = (frame.eye_from_scene * vec4(position, 1.0)).xyz;
    } else {
      eye_normal = mat3(frame.eye_from_scene) * normal_and_label.xyz;
    }
  }
  if ((features & (kMapped | kIsolines)) != 0) out_value = value;
  if ((features & kWire) != 0) {
    corner = vec2(normal_and_label.w < -0.5, normal_and_label.w > 0.5);
  }
}
