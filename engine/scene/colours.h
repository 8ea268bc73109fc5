// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace geotherm::engine {

/// A colour as the eye compares it: OKLab (B. Ottosson, "A perceptual color space for image
/// processing", 2020), x: lightness 0 to 1, y: green to red, z: blue to yellow. sRGB is as drawn, 0
/// to 1.
glm::vec3 oklab_of(const glm::vec3& srgb);
/// The result may lie outside of what screens show: below 0 or above 1.
glm::vec3 srgb_of(const glm::vec3& oklab);

/// A colour map from published control points, which the asset of its name holds
/// (assets/colour_maps/NAME.txt: what it is, its source, then one `r g b` a line, 0 to 255).
struct ColourMap {
  std::string_view name;
  std::string_view description;
  bool diverging = false;               ///< its middle stands for zero
  std::span<const glm::vec3> controls;  ///< sRGB, 0 to 1, evenly spaced from 0 to 1
};

/// All maps, the default first.
std::span<const ColourMap> colour_maps();
/// Null when there is no such name.
const ColourMap* find_colour_map(std::string_view name);

/// Fine enough to take the nearest one.
inline constexpr int kColourSteps = 1024;
using ColourTable = std::array<glm::vec4, kColourSteps>;

/// sRGB colour at x in [0, 1] (outside: the nearest end), linear between control points.
glm::vec3 colour_at(const ColourMap& map, float x, bool reversed = false);
/// What the shaders read: entry i is the colour at i / (kColourSteps - 1).
ColourTable colour_table(const ColourMap& map, bool reversed = false);

/// Colours of regions repeat after so many.
inline constexpr std::uint32_t kRegionColours = 48;

/// Colour i of an endless sequence (sRGB): hues a golden ratio apart and three lightnesses in turn,
/// as strong as a screen shows them. Any two of the first twelve differ by kDistinct or more.
glm::vec3 region_colour(std::uint32_t i);

/// Distance in OKLab of colours that nobody takes for each other; of black and white: 1.
inline constexpr float kDistinct = 0.13F;

/// Entry i is region_colour(i % kRegionColours): what Paint::kRegions is painted from.
ColourTable region_table();

/// Each vertex' place in region_table(), -1 where `regions` is negative. Region r has colour r, or
/// the next one that is distinct from those of all lower regions that a face of the mesh brings
/// next to it; where none is left, the one that is farthest from theirs. regions: one a vertex.
/// Cost: O(F) and the sorting of what lies on borders.
std::vector<std::int32_t> region_colour_places(std::span<const std::array<std::uint32_t, 3>> faces,
                                               std::span<const std::int32_t> regions);

}  // namespace geotherm::engine
