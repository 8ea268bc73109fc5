#version 460
// SPDX-License-Identifier: MIT
// Flat arrows on the surface: nine vertices (a shaft of two triangles, a head of one), one instance
// an arrow. Lengths come in scene units, already scaled to the view. A short arrow is as thick as a
// full one.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 tail;
layout(location = 1) in vec3 along;   // from tail to tip
layout(location = 2) in vec3 normal;  // of the face, unit length
layout(location = 3) in float full;   // the length of a full arrow

layout(push_constant) uniform PushBlock { ArrowPush push; };

layout(location = 0) out vec4 tint;

// In lengths of a full arrow: half the shaft's width, the head's length, half its width.
const float kShaft = 0.037;
const float kHead = 0.38;
const float kHeadSide = 0.16;

// x: 0 at the tail, 1 where the head begins, 2 at the tip; y: across, 1 is a side of the shaft, 2 of
// the head.
const vec2 kShape[9] = vec2[](
    vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(0, 1),
    vec2(1, -2), vec2(2, 0), vec2(1, 2));

void main() {
  vec2 shape = kShape[gl_VertexIndex];
  float size = length(along);
  vec3 forward = along / max(size, 1e-30);
  vec3 side = cross(normal, forward);
  float head = min(kHead * full, size);
  float x = shape.x < 0.5 ? 0.0 : shape.x < 1.5 ? size - head : size;
  float narrow = head / (kHead * full);  // a head alone keeps its shape
  float y = abs(shape.y) < 1.5 ? kShaft : kHeadSide * (0.35 + 0.65 * narrow);
  vec3 at = tail + x * forward + sign(shape.y) * y * full * side;
  vec4 clip = frame.clip_from_scene * vec4(at, 1.0);
  // Its depth is that of a point nearer to the eye: the surface bends away under an arrow that is
  // larger than its face.
  vec3 eye = (frame.eye_from_scene * vec4(at, 1.0)).xyz;
  vec3 to_eye = frame.orthographic > 0.5 ? vec3(0.0, 0.0, 1.0) : -normalize(eye);
  float shift = min(push.lift * full, -0.5 * eye.z);
  vec3 nearer = at + transpose(mat3(frame.eye_from_scene)) * to_eye * shift;
  vec4 lifted = frame.clip_from_scene * vec4(nearer, 1.0);
  clip.z = min(lifted.z / lifted.w, 1.0) * clip.w;
  gl_Position = in_tile(clip);
  tint = push.colour;
}
