#version 460
// SPDX-License-Identifier: MIT
// Flat shapes and letters over the picture, placed in its pixels.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec4 in_colour;

layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 colour;

void main() {
  gl_Position = in_tile(vec4(position / frame.extent * 2.0 - 1.0, 0.0, 1.0));
  uv = in_uv;
  colour = in_colour;
}
