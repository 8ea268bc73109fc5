#version 460
// SPDX-License-Identifier: MIT
// Flat arrows on the surface: nine vertices (a shaft of two triangles, a head of one), one instance
// an arrow. Lengths come in scene units, already scaled to the view.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 tail;
layout(location = 1) in vec3 along;   // from tail to tip
layout(location = 2) in vec3 normal;  // of the face, unit length

layout(push_constant) uniform PushBlock { ArrowPush push; };

layout(location = 0) out vec4 colour;

// x: along the arrow, 0 to 1; y: across, in lengths of a full arrow.
const vec2 kShape[9] = vec2[](
    vec2(0.0, -0.035), vec2(0.68, -0.035), vec2(0.68, 0.035),
    vec2(0.0, -0.035), vec2(0.68, 0.035), vec2(0.0, 0.035),
    vec2(0.62, -0.16), vec2(1.0, 0.0), vec2(0.62, 0.16));

void main() {
  vec2 p = kShape[gl_VertexIndex];
  vec3 across = cross(normal, along);
  vec3 at = tail + p.x * along + p.y * across;
  gl_Position = frame.clip_from_scene * vec4(at, 1.0);
  // Its depth is that of a point nearer to the eye by a third of its length: the surface bends away
  // under an arrow that is larger than its face.
  vec3 eye = (frame.eye_from_scene * vec4(at, 1.0)).xyz;
  vec3 to_eye = frame.orthographic > 0.5 ? vec3(0.0, 0.0, 1.0) : -normalize(eye);
  float depth = -eye.z;
  float shift = min(0.35 * length(along), 0.5 * depth);
  vec4 nearer = frame.clip_from_scene * vec4(at + transpose(mat3(frame.eye_from_scene)) * to_eye * shift, 1.0);
  gl_Position.z = min(nearer.z / nearer.w, 1.0) * gl_Position.w;
  colour = push.colour;
}
