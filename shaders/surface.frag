#version 460
// SPDX-License-Identifier: MIT
// The mesh's colour: plain or by value, isolines, edges, light. Lines are drawn where a pixel is
// near one, measured with the derivative of what they are lines of, so that they keep their width on
// screen; where they come too close to tell apart they fade into their mean.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(constant_id = 0) const uint features = 0;

// A texel buffer: the one table look-up that software devices do not check component by component.
layout(set = 0, binding = kColoursBinding) uniform samplerBuffer colours;

layout(location = 0) in vec4 eye_and_value;  // see surface.vert
layout(location = 1) in vec2 corner;

layout(location = 2) in vec3 corner_margins;
layout(location = 3) in vec3 corner_regions;
layout(location = 4) in vec2 open;  // how much light comes to both sides

layout(location = 0) out vec4 colour;

// What is larger, either way, comes from a corner without a value, weighted or extrapolated.
const float kLargestValue = 1e20;
const vec3 kNoValueColour = vec3(0.62);

// Of the light, what is missing where none comes from around, and at an outline; the cosine to the
// eye below which one begins.
const float kHollowShade = 0.65;
const float kOutlineShade = 0.35;
const float kOutline = 0.45;

// How bright a surface is whose unit normal is `n` in eye space (x right, y up, z to the eye).
// A face that looks at the key light keeps its colour: what a colour map says stays readable.

float headlight(vec3 n) { return 0.35 + 0.65 * max(n.z, 0.0); }

// Key from above left, fill from the right, rim from behind above; each wraps around the edge so
// that no part turns black.
float three_points(vec3 n) {
  const vec3 key = vec3(-0.4575, 0.6100, 0.6468);
  const vec3 fill = vec3(0.7809, 0.0976, 0.6170);
  const vec3 rim = vec3(0.1374, 0.6868, -0.7137);
  float k = max(dot(n, key) * 0.8 + 0.2, 0.0);
  float f = max(dot(n, fill) * 0.7 + 0.3, 0.0);
  float r = max(dot(n, rim), 0.0);
  return min(0.24 + 0.68 * k + 0.22 * f + 0.20 * r, 1.08);
}

vec3 colour_number(int i) { return texelFetch(colours, i).rgb; }

vec3 map_colour(float x) {
  x = clamp(x, 0.0, 1.0);
  float bands = frame.level_count.y;
  // The middle of the band, whose border itself belongs to the band above.
  if (bands > 0.0) x = (min(floor(x * bands + 1e-4), bands - 1.0) + 0.5) / bands;
  return colour_number(int(x * float(kColourSteps - 1) + 0.5));
}

// On the colour map, 0 to 1 between its ends.
float place_of(float value) {
  float measure = (features & kLogarithmic) != 0 ? log2(max(value + frame.range.w, 1e-37)) : value;
  return measure * frame.range.x + frame.range.y;
}

#include "regions.glsl"

// Lines so close that they are only their mean leave the colours readable.
const float kDensest = 0.5;

// 0 where a value is the same all around but for rounding, which would be all line: `change` is the
// square of what it changes by from pixel to pixel.
float varies(float change, float value) { return change > 1e-12 * value * value ? 1.0 : 0.0; }

// Share of the pixel that isolines cover; `phase` is the value in spacings, and lines are the zeros of
// sin(pi phase) but the one at 0, where the sources are. `line`: the value of the nearest.
float isolines(float phase, out float line) {
  float dx = dFdx(phase);
  float dy = dFdy(phase);
  float change = dx * dx + dy * dy;
  float square = change + 1e-30;
  float apart = inversesqrt(square);  // pixels from line to line
  line = max(round(phase), 1.0);
  float away = abs(phase - line) * apart;
  float width = frame.line.w;
  float cover = clamp(0.5 * width + 0.5 - away, 0.0, 1.0);
  float mean = min(width * (square * apart), kDensest);
  return varies(change, phase) * mix(mean, cover, clamp(0.3 * apart - 0.75, 0.0, 1.0));
}

// The same of lines at chosen values, measured from the nearest of them.
float level_lines(float value, out float line) {
  float dx = dFdx(value);
  float dy = dFdy(value);
  float change = dx * dx + dy * dy;
  float pixels = inversesqrt(change + 1e-30);  // of a value of 1
  line = kLargestValue;
  for (int i = 0; i < int(frame.level_count.x); ++i) {
    float level = frame.levels[i / 4][i % 4];
    line = abs(value - level) < abs(value - line) ? level : line;
  }
  float away = abs(value - line) * pixels;
  return varies(change, value) * clamp(0.5 * frame.line.w + 0.5 - away, 0.0, 1.0);
}

// Share of the pixel that the triangle's edges cover. b: distance from each side over its height.
float edges(vec3 b) {
  float width = frame.wire.w;
  vec3 dx = dFdx(b);
  vec3 dy = dFdy(b);
  vec3 height = inversesqrt(dx * dx + dy * dy + 1e-20);  // pixels
  vec3 cover = clamp(0.5 * width + 0.5 - b * height, 0.0, 1.0);
  // Not where triangles are a few pixels large. Their three edges fade together: one direction alone
  // would leave rows.
  float least = min(height.x, min(height.y, height.z));
  float most = max(height.x, max(height.y, height.z));
  float fade = clamp(sqrt(least * most) * (0.25 / width) - 0.5, 0.0, 1.0);
  return max(cover.x, max(cover.y, cover.z)) * fade;
}

// What shows the form of a surface whatever its colour: less light in hollows, and less towards
// outlines, where it turns away from the eye.
float form(vec3 n) {
  float light = gl_FrontFacing ? open.x : open.y;
  vec3 to_eye = normalize(vec3(-(gl_FragCoord.xy * frame.sight.xy + frame.sight.zw), 1.0));
  float facing = clamp(dot(n, to_eye) * (1.0 / kOutline), 0.0, 1.0);
  float outline = 1.0 - kOutlineShade * (1.0 - facing) * (1.0 - facing);
  return (1.0 - kHollowShade * (1.0 - light)) * outline;
}

float brightness() {
  if ((features & kNoLight) != 0) return 1.0;
  vec3 n;
  if ((features & kFlat) != 0) {
    n = cross(dFdx(eye_and_value.xyz), dFdy(eye_and_value.xyz));
    n = n.z < 0.0 ? -n : n;
  } else {
    n = gl_FrontFacing ? eye_and_value.xyz : -eye_and_value.xyz;
  }
  float size = length(n);
  n = size > 0.0 ? n / size : vec3(0.0, 0.0, 1.0);
  float light = (features & kThreeLights) != 0 ? three_points(n) : headlight(n);
  bool means = (features & (kMapped | kRegions)) != 0;  // such colours are dimmed less
  if ((features & kForm) != 0) light *= means ? mix(1.0, form(n), 0.6) : form(n);
  return means ? 0.3 + 0.7 * light : light;
}

void main() {
  vec3 c = frame.plain.rgb;
  float lines = 0.0;
  float value = eye_and_value.w;
  // Computed first and chosen from then: cheaper than branches.
  bool known = abs(value) < kLargestValue;
  float place = place_of(value);
  if ((features & kMapped) != 0) {
    vec3 mapped = map_colour(place);
    c = known ? mapped : kNoValueColour;
  }
  if ((features & kRegions) != 0) c = region_colour();
  if ((features & (kIsolines | kLevels)) != 0) {
    float line;
    float cover = (features & kLevels) != 0 ? level_lines(value, line) : isolines(value, line);
    // A line at an end of the map's range is whole.
    bool within = (features & kMapped) == 0 || abs(place_of(line) - 0.5) < 0.5001;
    lines = known && within ? cover : 0.0;
  }
  float wire = 0.0;
  if ((features & kWire) != 0) wire = edges(vec3(corner, 1.0 - corner.x - corner.y));
  c *= brightness();
  c = mix(c, frame.line.rgb, lines);
  c = mix(c, frame.wire.rgb, wire);
  colour = vec4(c, 1.0);
}
