// SPDX-License-Identifier: MIT
// The frame's uniforms. Included by every shader of the scene.
#include "shared.h"

layout(std140, set = 0, binding = kFrameBinding) uniform FrameBlock { Frame frame; };

// Clip coordinates of the whole picture as those of the tile that is drawn.
vec4 in_tile(vec4 clip) {
  return vec4(clip.xy * frame.tile.xy + clip.w * frame.tile.zw, clip.zw);
}
