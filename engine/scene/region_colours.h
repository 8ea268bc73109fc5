// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/colour_map.h"

namespace geotherm::engine {

/// Colours of regions repeat after so many.
inline constexpr std::uint32_t kRegionColours = 48;

/// Colour i of an endless sequence (sRGB): hues a golden ratio apart and three lightnesses in turn,
/// as strong as a screen shows them. Any two of the first twelve differ by kDistinct or more.
glm::vec3 region_colour(std::uint32_t i);

/// Distance (colour_distance) of colours that nobody takes for each other.
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
