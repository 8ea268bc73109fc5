#version 460
// SPDX-License-Identifier: MIT
// A filled stadium with a rim, antialiased by its distance in pixels. Colours go out multiplied by
// their coverage.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(push_constant) uniform PushBlock { MarkerPush push; };

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec2 segment;

layout(location = 0) out vec4 colour;

void main() {
  float along = clamp(dot(at, segment) / max(dot(segment, segment), 1e-6), 0.0, 1.0);
  float away = length(at - along * segment);
  float radius = frame.marker.w;
  float cover = clamp(radius + 0.5 - away, 0.0, 1.0) * push.opacity;
  if (cover <= 0.0) discard;
  float rim = clamp(away - 0.68 * radius + 0.5, 0.0, 1.0);
  colour = vec4(mix(frame.marker.rgb, frame.marker_rim.rgb, rim), 1.0) * cover;
}
