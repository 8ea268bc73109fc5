#version 460
// SPDX-License-Identifier: MIT
// The mesh's colour: plain or by value, isolines, edges, light. Lines are drawn where a pixel is
// near one, measured with the derivative of what they are lines of, so that they keep their width on
// screen; where they come too close to tell apart they fade into their mean.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"

layout(constant_id = 0) const uint features = 0;

layout(std140, set = 0, binding = kColoursBinding) uniform ColoursBlock { Colours colours; };

layout(location = 0) in vec3 eye_normal;
layout(location = 1) in vec3 eye_position;
layout(location = 2) in float value;
layout(location = 3) in vec2 corner;

layout(location = 0) out vec4 colour;

const float kPi = 3.14159265;
const float kNoValueBelow = -1e38;
const vec3 kNoValueColour = vec3(0.62);

float screen_gradient(float x) { return length(vec2(dFdx(x), dFdy(x))); }

vec3 map_colour(float x) {
  float at = clamp(x, 0.0, 1.0) * float(kColourSteps - 1);
  uint below = min(uint(at), kColourSteps - 2);
  return mix(colours.steps[below].rgb, colours.steps[below + 1].rgb, at - float(below));
}

// Share of the pixel that lines at the multiples of `spacing` cover, the zeros of
// sin(pi value / spacing). There is no line at 0, where the sources are.
float isolines(float v, float gradient) {
  float spacing = frame.range.z;
  float width = frame.line.w;
  float apart = spacing / max(gradient, 1e-30);  // pixels from line to line
  float away = abs(sin(kPi * v / spacing)) * apart / kPi;
  float cover = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * step(0.5 * spacing, v);
  float mean = min(width / apart, 1.0);
  return mix(mean, cover, smoothstep(2.5, 6.0, apart));
}

// Share of the pixel that the triangle's edges cover. b: distance from each side over its height.
float edges(vec3 b) {
  float width = frame.wire.w;
  vec3 gradient = vec3(screen_gradient(b.x), screen_gradient(b.y), screen_gradient(b.z));
  vec3 height = 1.0 / max(gradient, 1e-30);  // pixels
  vec3 cover = clamp(0.5 * width + 0.5 - b * height, 0.0, 1.0);
  cover *= smoothstep(2.0 * width, 7.0 * width, height);  // not where triangles are a few pixels
  return max(cover.x, max(cover.y, cover.z));
}

float brightness() {
  if ((features & kNoLight) != 0) return 1.0;
  vec3 n;
  if ((features & kFlat) != 0) {
    n = cross(dFdx(eye_position), dFdy(eye_position));
    n = n.z < 0.0 ? -n : n;
  } else {
    n = gl_FrontFacing ? eye_normal : -eye_normal;
  }
  float size = length(n);
  n = size > 0.0 ? n / size : vec3(0.0, 0.0, 1.0);
  return (features & kThreeLights) != 0 ? three_points(n) : headlight(n);
}

void main() {
  vec3 c = frame.plain.rgb;
  float lines = 0.0;
  if ((features & (kMapped | kIsolines)) != 0) {
    float gradient = screen_gradient(value);
    bool known = value > kNoValueBelow;
    if ((features & kMapped) != 0) {
      c = known ? map_colour((value - frame.range.x) * frame.range.y) : kNoValueColour;
    }
    if ((features & kIsolines) != 0 && known) lines = isolines(value, gradient);
  }
  float wire = 0.0;
  if ((features & kWire) != 0) wire = edges(vec3(corner, 1.0 - corner.x - corner.y));
  c *= brightness();
  c = mix(c, frame.line.rgb, lines);
  c = mix(c, frame.wire.rgb, wire);
  colour = vec4(min(c, vec3(1.0)), 1.0);
}
