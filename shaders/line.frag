#version 460
// SPDX-License-Identifier: MIT
// A piece of a line, antialiased by its distance in pixels: first the rim of all pieces, then their
// insides. Colours go out multiplied by their coverage.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(push_constant) uniform PushBlock { LinePush push; };

layout(location = 0) flat in vec4 ends;
layout(location = 1) flat in vec4 bisectors;
layout(location = 2) flat in vec2 run;

layout(location = 0) out vec4 colour;

void main() {
  // From the pixel itself, not interpolated: neighbours are to agree about whose it is.
  precise vec2 p = gl_FragCoord.xy + frame.polyline.zw;
  precise float after_a = dot(p - ends.xy, bisectors.xy);
  precise float after_b = dot(p - ends.zw, bisectors.zw);
  if (after_a < 0.0 || (after_b >= 0.0 && bisectors.zw != vec2(0.0))) discard;
  vec2 segment = ends.zw - ends.xy;
  vec2 at = p - ends.xy;
  float along = clamp(dot(at, segment) / max(dot(segment, segment), 1e-12), 0.0, 1.0);
  float cover = clamp(push.half_width + 0.5 - length(at - along * segment), 0.0, 1.0);
  if (cover <= 0.0) discard;
  if (push.dash > 0.0) {
    float pixel = (run.y - run.x) / push.dash / max(length(segment), 1.0);
    float from_middle = abs(fract(mix(run.x, run.y, along) / push.dash) - 0.5);
    const float kHalfDash = 0.3;  // of what it is from dash to dash
    cover *= clamp((kHalfDash - from_middle) / max(pixel, 1e-6) + 0.5, 0.0, 1.0);
  }
  colour = push.colour * cover;
}
