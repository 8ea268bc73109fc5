// SPDX-License-Identifier: MIT
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
