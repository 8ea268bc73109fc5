#version 460
// SPDX-License-Identifier: MIT
// Lines on the surface, of constant width on screen: four vertices a straight piece, one instance
// each. Where two pieces meet each keeps its side of the bisector, so that no pixel belongs to both
// however short they are; sharp turns and ends are round.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 before;
layout(location = 1) in vec3 from;
layout(location = 2) in vec3 to;
layout(location = 3) in vec3 after;
layout(location = 4) in float at_from;  // along the line, scene units

layout(location = 0) flat out vec4 ends;       // both ends, pixels of the picture
layout(location = 1) flat out vec4 bisectors;  // directions across which it meets its neighbours; 0: none
layout(location = 2) flat out vec2 run;        // along the line at both ends, scene units

const float kNearest = 1e-4;  // to the eye
const float kShortest = 1e-3;  // pixels; what is shorter has no direction

// Exact, as each point is computed for up to four pieces, which are to agree about it.
precise vec2 pixels(vec4 clip) { return (clip.xy / clip.w * 0.5 + 0.5) * frame.extent; }

precise vec4 clip_of(vec3 point) { return frame.clip_from_scene * vec4(point, 1.0); }

// The direction along the line where two pieces meet, from where they come to where they go.
precise vec2 bisector(vec2 a, vec2 b, vec2 c) {
  vec2 u = b - a;
  vec2 v = c - b;
  float lu = length(u);
  float lv = length(v);
  if (min(lu, lv) < kShortest) return vec2(0.0);
  u /= lu;
  v /= lv;
  return dot(u, v) > 0.0 ? u + v : vec2(0.0);
}

// How far a piece with this direction reaches beyond its end, for a line of half its width 1.
float overhang(vec2 along, vec2 across) {
  if (across == vec2(0.0)) return 1.0;
  return abs(along.x * across.y - along.y * across.x) / max(dot(along, across), 1e-6);
}

void main() {
  ends = bisectors = vec4(0.0);
  run = at_from + vec2(0.0, distance(from, to));
  vec4 a = clip_of(from);
  vec4 b = clip_of(to);
  if (a.w < kNearest && b.w < kNearest) {
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    return;
  }
  // A piece that passes the eye is cut where it comes too close.
  bool joins_a = a.w >= kNearest && before != from;
  bool joins_b = b.w >= kNearest && after != to;
  if (a.w < kNearest) a = mix(a, b, (kNearest - a.w) / (b.w - a.w));
  if (b.w < kNearest) b = mix(b, a, (kNearest - b.w) / (a.w - b.w));
  vec2 pa = pixels(a);
  vec2 pb = pixels(b);
  ends = vec4(pa, pb);
  vec4 z = clip_of(before);
  vec4 c = clip_of(after);
  if (joins_a && z.w >= kNearest) bisectors.xy = bisector(pixels(z), pa, pb);
  if (joins_b && c.w >= kNearest) bisectors.zw = bisector(pa, pb, pixels(c));

  vec2 d = pb - pa;
  float size = length(d);
  vec2 along = size > kShortest ? d / size : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float reach = frame.polyline.y + 0.5;
  const float kPixel = 0.75;  // from its middle to its farthest sample
  bool second = (gl_VertexIndex & 1) != 0;
  float side = (gl_VertexIndex & 2) != 0 ? 1.0 : -1.0;
  float beyond = reach * overhang(along, second ? bisectors.zw : bisectors.xy) + kPixel;
  vec2 p = (second ? pb + along * beyond : pa - along * beyond) + side * across * (reach + kPixel);
  // Beyond its ends its depth runs on, but not where it turns away from the eye.
  float depth_a = nearer_depth(a, frame.polyline.y);
  float depth_b = nearer_depth(b, frame.polyline.y);
  float on = min(beyond / max(size, kShortest), 1.0) * (depth_b - depth_a);
  float depth = min(second ? depth_b + on : depth_a - on, 1.0);
  gl_Position = in_tile(vec4(p / frame.extent * 2.0 - 1.0, depth, 1.0));
}
