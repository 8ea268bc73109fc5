// SPDX-License-Identifier: MIT
// The frame's uniforms. Included by every shader of the scene.
#include "shared.h"

layout(std140, set = 0, binding = kFrameBinding) uniform FrameBlock { Frame frame; };

// Clip coordinates of the whole picture as those of the tile that is drawn.
vec4 in_tile(vec4 clip) {
  return vec4(clip.xy * frame.tile.xy + clip.w * frame.tile.zw, clip.zw);
}

// The depth of a point (in clip coordinates of the whole picture) moved towards the eye by some of
// the radius in pixels of what is drawn about it: that faces the eye, and the surface beside the
// point may well be in front of it. Radius < 0: moved away from the eye.
float nearer_depth(vec4 clip, float radius) {
  mat4 m = frame.clip_from_scene;
  mat4 e = frame.eye_from_scene;
  vec4 per_unit = m * vec4(e[0].z, e[1].z, e[2].z, 0.0);  // towards the eye
  float unit = 0.5 * frame.extent.y * length(vec3(m[0].y, m[1].y, m[2].y)) / clip.w;  // pixels
  float shift = min(frame.near_shift * radius / unit, 0.5 * clip.w);
  return clamp((clip.z + shift * per_unit.z) / (clip.w + shift * per_unit.w), 0.0, 1.0);
}
