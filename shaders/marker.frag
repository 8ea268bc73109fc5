#version 460
// SPDX-License-Identifier: MIT
// A stadium, antialiased by its distance in pixels: first all rims, then all insides, so that pieces
// of a curve join. Hidden ones are faint and end without caps: where two overlapped they would show.
// Colours go out multiplied by their coverage.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(push_constant) uniform PushBlock { MarkerPush push; };

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec2 segment;
layout(location = 2) flat in float radius;

layout(location = 0) out vec4 colour;

void main() {
  float along = dot(at, segment) / max(dot(segment, segment), 1e-6);
  bool inside = push.inside > 0.5;
  if (push.opacity < 1.0 && radius < frame.marker.w && (along < 0.0 || along >= 1.0)) discard;
  float away = length(at - clamp(along, 0.0, 1.0) * segment);
  float reach = inside ? frame.marker_rim.w * radius : radius;
  float cover = clamp(reach + 0.5 - away, 0.0, 1.0) * push.opacity;
  if (cover <= 0.0) discard;
  colour = vec4(inside ? frame.marker.rgb : frame.marker_rim.rgb, 1.0) * cover;
}
