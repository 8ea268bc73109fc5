// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace geotherm::engine {

/// How much farther each vertex beside a border is from the other side's source than from its own:
/// what decides where between vertices the border runs (Paint::kRegions). The other distance is
/// continued linearly from the vertices beyond, by the gradients there, or where there are none by
/// the way along the edge. Above 0; 1 away from borders and without distances. regions: V, negative
/// where there is none. distances: V, scene units, or empty; those that are not finite or huge are
/// none. Cost: O(F), and a logarithm for what lies on borders.
std::vector<float> region_margins(const SurfaceGeometry& geometry,
                                  std::span<const std::int32_t> regions,
                                  std::span<const float> distances);

}  // namespace geotherm::engine
