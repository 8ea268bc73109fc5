// SPDX-License-Identifier: MIT
// Which region a point of a triangle belongs to, from those of the corners. Included by surface.frag.
//
// On an edge of length L between regions a and b the border lies at (L + d_b - d_a) / 2 from a, where
// fronts that run along it meet; without values in the middle. Within a triangle of two regions it is
// straight. Where three meet, a corner's value grows away from it at most by the way, d + |p - corner|,
// taken as linear between the corners; the least of the three decides.

// Of corners that are nearly opposite only noise is left.
const float kLeastWeight = 1e-4;

// Of the line between regions, in widths of isolines, which are thinner.
const float kBorderWidth = 1.6;

struct Corners {
  vec3 weight;           // barycentric coordinates of the pixel
  vec3 weight_x;         // what they change by from pixel to pixel
  vec3 weight_y;
  vec3 length_opposite;  // of the edge opposite to each corner, scene units
};

// The triangle's edges from two derivatives on screen: the place is linear in the weights, so that
// its differences between pixels are those of the weights times the edges.
Corners corners_of_triangle() {
  vec2 bx = dFdx(corner);
  vec2 by = dFdy(corner);
  vec3 px = dFdx(eye);
  vec3 py = dFdy(eye);
  float area = bx.x * by.y - bx.y * by.x;
  vec3 to_0 = (px * by.y - py * bx.y) / area;  // from corner 2
  vec3 to_1 = (py * bx.x - px * by.x) / area;
  vec3 lengths = vec3(length(to_1), length(to_0), length(to_0 - to_1));
  Corners c;
  c.weight = vec3(corner, 1.0 - corner.x - corner.y);
  c.weight_x = vec3(bx, -bx.x - bx.y);
  c.weight_y = vec3(by, -by.x - by.y);
  const float kScene = 4.0;  // longer than any edge: seen from the side, or no number
  bool sound = lengths.x < kScene && lengths.y < kScene && lengths.z < kScene;
  c.length_opposite = sound ? lengths : vec3(1.0);
  return c;
}

// Ways from each corner to the point with these weights.
vec3 ways(vec3 weight, vec3 opposite) {
  return vec3(weight.y * opposite.z + weight.z * opposite.y,
              weight.z * opposite.x + weight.x * opposite.z,
              weight.x * opposite.y + weight.y * opposite.x);
}

vec3 colour_of_region(int region) {
  return region < 1 ? kNoValueColour : colour_number(min(region, int(kColourSteps)) - 1);
}

// Colours of two regions, and how far it is from their border into the first one, pixels; the border
// is drawn as a line.
vec3 beside_border(int first, int second, float inside) {
  float cover = clamp(0.5 + inside, 0.0, 1.0);
  vec3 c = mix(colour_of_region(second), colour_of_region(first), cover);
  float line = clamp(0.5 * kBorderWidth * frame.line.w + 0.5 - abs(inside), 0.0, 1.0);
  return mix(c, frame.line.rgb, line);
}

// Corner `a` has a region of its own, the other two share one.
vec3 colour_of_two(int a, Corners c, ivec3 region, vec3 value) {
  int b = (a + 1) % 3;
  int d = (a + 2) % 3;
  // Places of the border on both edges from a, as shares of them.
  vec2 edge = vec2(c.length_opposite[d], c.length_opposite[b]);
  vec2 place = 0.5 + 0.5 * (vec2(value[b], value[d]) - value[a]) / max(edge, vec2(1e-20));
  place = clamp(place, 0.01, 0.99);
  vec2 other = (1.0 - place) / place;
  float inside = c.weight[a] - dot(other, vec2(c.weight[b], c.weight[d]));
  vec2 slope = vec2(c.weight_x[a] - dot(other, vec2(c.weight_x[b], c.weight_x[d])),
                    c.weight_y[a] - dot(other, vec2(c.weight_y[b], c.weight_y[d])));
  return beside_border(region[a], region[b], inside / max(length(slope), 1e-20));
}

vec3 colour_of_three(Corners c, ivec3 region, vec3 value) {
  vec3 reach = value + ways(c.weight, c.length_opposite);
  vec3 reach_x = ways(c.weight_x, c.length_opposite);
  vec3 reach_y = ways(c.weight_y, c.length_opposite);
  int first = reach.x <= min(reach.y, reach.z) ? 0 : reach.y <= reach.z ? 1 : 2;
  int second = first;
  float inside = kBorderWidth * frame.line.w + 1.0;  // beyond the line
  for (int k = 0; k < 3; ++k) {
    vec2 slope = vec2(reach_x[k] - reach_x[first], reach_y[k] - reach_y[first]);
    float pixels = (reach[k] - reach[first]) / max(length(slope), 1e-20);
    if (k == first || pixels >= inside) continue;
    inside = pixels;
    second = k;
  }
  return beside_border(region[first], region[second], inside);
}

vec3 region_colour() {
  Corners c = corners_of_triangle();
  bvec3 far = lessThan(abs(c.weight), vec3(kLeastWeight));
  vec3 weight = mix(c.weight, vec3(1.0), far);
  ivec3 region = ivec3(corner_regions / weight + 0.5);
  vec3 value = corner_values / weight * frame.range.w;
  int nearest = c.weight.x >= max(c.weight.y, c.weight.z) ? 0 : c.weight.y >= c.weight.z ? 1 : 2;
  for (int k = 0; k < 3; ++k) {
    if (!far[k]) continue;
    region[k] = region[nearest];
    value[k] = value[nearest];
  }
  if (region.y == region.z && region.x == region.y) return colour_of_region(region.x);
  if (region.y == region.z) return colour_of_two(0, c, region, value);
  if (region.x == region.z) return colour_of_two(1, c, region, value);
  if (region.x == region.y) return colour_of_two(2, c, region, value);
  return colour_of_three(c, region, value);
}
