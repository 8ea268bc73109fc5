// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace geotherm::engine {

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

}  // namespace geotherm::engine
