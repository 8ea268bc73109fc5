#version 460
// SPDX-License-Identifier: MIT
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = kAtlasBinding) uniform sampler2D atlas;

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 in_colour;

layout(location = 0) out vec4 colour;

void main() {
  float alpha = in_colour.a * texture(atlas, uv).r;
  colour = vec4(in_colour.rgb * alpha, alpha);
}
