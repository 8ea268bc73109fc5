#version 460
// SPDX-License-Identifier: MIT
// Sources: a disc of constant size on screen for a point, a stadium of half its width about a piece
// of a curve. Four vertices, one instance a marker.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 outward;  // which way the faces look, and the sine of how far from that

layout(location = 0) out vec2 at;            // pixels, from the segment's first end
layout(location = 1) flat out vec2 segment;  // its other end, pixels
layout(location = 2) flat out float radius;  // pixels

// Whether all faces about the marker look away from the eye.
bool faces_away() {
  vec3 middle = (frame.eye_from_scene * vec4(0.5 * (from + to), 1.0)).xyz;
  vec3 to_eye = frame.orthographic > 0.5 ? vec3(0.0, 0.0, 1.0) : -normalize(middle);
  return dot(mat3(frame.eye_from_scene) * outward.xyz, to_eye) < -outward.w;
}

vec2 pixels(vec4 clip) { return (clip.xy / clip.w * 0.5 + 0.5) * frame.extent; }

void main() {
  radius = from == to ? frame.marker.w : 0.5 * frame.marker.w;
  vec4 a = frame.clip_from_scene * vec4(from, 1.0);
  vec4 b = frame.clip_from_scene * vec4(to, 1.0);
  // A segment that passes the eye is cut where it comes too close.
  const float kNearest = 1e-4;
  if (a.w < kNearest && b.w < kNearest) {
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    at = segment = vec2(0.0);
    return;
  }
  if (a.w < kNearest) a = mix(a, b, (kNearest - a.w) / (b.w - a.w));
  if (b.w < kNearest) b = mix(b, a, (kNearest - b.w) / (a.w - b.w));
  vec2 pa = pixels(a);
  vec2 pb = pixels(b);
  vec2 d = pb - pa;
  float size = length(d);
  vec2 along = size > 1e-3 ? d / size : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float reach = radius + 2.0;
  bool second = (gl_VertexIndex & 1) != 0;
  float side = (gl_VertexIndex & 2) != 0 ? 1.0 : -1.0;
  vec2 p = (second ? pb + along * reach : pa - along * reach) + side * across * reach;
  at = p - pa;
  segment = d;
  // Through a thin body, what is on its other side would come to the front, and half of it does
  // where it stays on a plane that is inclined.
  float depth = nearer_depth(second ? b : a, faces_away() ? -radius : radius);
  gl_Position = in_tile(vec4(p / frame.extent * 2.0 - 1.0, depth, 1.0));
}
