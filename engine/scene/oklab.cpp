// SPDX-License-Identifier: MIT
#include "engine/scene/oklab.h"

#include <cmath>

namespace geotherm::engine {
namespace {

float linear_of(float c) {
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

float encoded(float c) {
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
}

}  // namespace

glm::vec3 oklab_of(const glm::vec3& srgb) {
  const glm::vec3 c(linear_of(srgb.r), linear_of(srgb.g), linear_of(srgb.b));
  const float l = std::cbrt(0.4122214708F * c.r + 0.5363325363F * c.g + 0.0514459929F * c.b);
  const float m = std::cbrt(0.2119034982F * c.r + 0.6806995451F * c.g + 0.1073969566F * c.b);
  const float s = std::cbrt(0.0883024619F * c.r + 0.2817188376F * c.g + 0.6299787005F * c.b);
  return {0.2104542553F * l + 0.7936177850F * m - 0.0040720468F * s,
          1.9779984951F * l - 2.4285922050F * m + 0.4505937099F * s,
          0.0259040371F * l + 0.7827717662F * m - 0.8086757660F * s};
}

glm::vec3 srgb_of(const glm::vec3& oklab) {
  const float l = oklab.x + 0.3963377774F * oklab.y + 0.2158037573F * oklab.z;
  const float m = oklab.x - 0.1055613458F * oklab.y - 0.0638541728F * oklab.z;
  const float s = oklab.x - 0.0894841775F * oklab.y - 1.2914855480F * oklab.z;
  const glm::vec3 cube(l * l * l, m * m * m, s * s * s);
  return {encoded(4.0767416621F * cube.x - 3.3077115913F * cube.y + 0.2309699292F * cube.z),
          encoded(-1.2684380046F * cube.x + 2.6097574011F * cube.y - 0.3413193965F * cube.z),
          encoded(-0.0041960863F * cube.x - 0.7034186147F * cube.y + 1.7076147010F * cube.z)};
}

float colour_distance(const glm::vec3& a, const glm::vec3& b) {
  return glm::length(oklab_of(a) - oklab_of(b));
}

}  // namespace geotherm::engine
