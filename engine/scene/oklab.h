// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

// Colours as the eye compares them: OKLab (B. Ottosson, "A perceptual color space for image
// processing", 2020), x: lightness 0 to 1, y: green to red, z: blue to yellow. sRGB as drawn, 0
// to 1.
namespace geotherm::engine {

glm::vec3 oklab_of(const glm::vec3& srgb);
/// May lie outside of what screens show: below 0 or above 1.
glm::vec3 srgb_of(const glm::vec3& oklab);

/// How different two sRGB colours look: the distance of both in OKLab. Black and white: 1.
float colour_distance(const glm::vec3& a, const glm::vec3& b);

}  // namespace geotherm::engine
