// SPDX-License-Identifier: MIT
// Which region a point of a triangle belongs to, from those of the corners. Included by surface.frag.
//
// Each corner has a margin: how much farther it is from the source of the region beyond than from its
// own. The difference of both distances is linear within a triangle, so that a region's claim at a
// point is the sum of its corners' margins, each times its weight there; the greatest claim decides.
// Borders are straight within triangles and continue across their edges.

// Of corners that are nearly opposite only noise is left.
const float kLeastWeight = 1e-4;

// Of the line between regions, in widths of isolines, which are thinner.
const float kBorderWidth = 1.6;

vec3 colour_of_region(int region) {
  return region < 1 ? kNoValueColour : colour_number(min(region, int(kColourSteps)) - 1);
}

vec3 region_colour() {
  vec3 own_weight = vec3(corner, 1.0 - corner.x - corner.y);
  vec3 x = dFdx(corner_margins);
  vec3 y = dFdy(corner_margins);
  bvec3 far = lessThan(abs(own_weight), vec3(kLeastWeight));
  ivec3 region = ivec3(corner_regions / mix(own_weight, vec3(1.0), far) + 0.5);
  int nearest = own_weight.x >= max(own_weight.y, own_weight.z) ? 0
                : own_weight.y >= own_weight.z                    ? 1
                                                                  : 2;
  for (int k = 0; k < 3; ++k) region[k] = far[k] ? region[nearest] : region[k];
  if (region.y == region.z && region.x == region.y) return colour_of_region(region.x);

  // Claims, and how they change from pixel to pixel, of the region of each corner.
  mat3 same;
  for (int k = 0; k < 3; ++k) same[k] = vec3(equal(region, ivec3(region[k])));
  vec3 claim = corner_margins * same;
  vec3 claim_x = x * same;
  vec3 claim_y = y * same;
  int first = claim.x >= max(claim.y, claim.z) ? 0 : claim.y >= claim.z ? 1 : 2;
  int second = first;
  float inside = kBorderWidth * frame.line.w + 1.0;  // pixels; beyond the line
  for (int k = 0; k < 3; ++k) {
    if (region[k] == region[first]) continue;
    vec2 slope = vec2(claim_x[first] - claim_x[k], claim_y[first] - claim_y[k]);
    float pixels = (claim[first] - claim[k]) / max(length(slope), 1e-20);
    if (pixels >= inside) continue;
    inside = pixels;
    second = k;
  }
  float cover = clamp(0.5 + inside, 0.0, 1.0);
  vec3 c = mix(colour_of_region(region[second]), colour_of_region(region[first]), cover);
  float line = clamp(0.5 * kBorderWidth * frame.line.w + 0.5 - inside, 0.0, 1.0);
  return mix(c, frame.line.rgb, line);
}
