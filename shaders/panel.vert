#version 460
// SPDX-License-Identifier: MIT
// Panels over the picture, placed in pixels of the target.
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec4 in_colour;

layout(push_constant) uniform PushBlock { PanelPush push; };

layout(location = 0) out vec2 uv;
layout(location = 1) out vec4 colour;

void main() {
  gl_Position = vec4(position * push.clip_of_pixel - 1.0, 0.0, 1.0);
  uv = in_uv;
  colour = in_colour;
}
