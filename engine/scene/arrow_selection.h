// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/arrow_places.h"

namespace geotherm::engine {

/// An arrow to draw; lengths in scene units.
struct ArrowInstance {
  glm::vec3 tail, along, normal;
  float full;  ///< length of an arrow whose vector has length 1
};

struct ArrowSelection {
  std::vector<ArrowInstance> primary, secondary;
};

/// What arrows are drawn on.
struct ArrowSurface {
  SurfaceGeometry geometry;
  const ArrowPlaces& places;
};

/// The arrows that this view has room for: those whose places are further apart than
/// style.spacing * scale pixels where they stand, and that are inside the picture; faces that are
/// much larger than that carry a grid of them, and backs of solids none. Each is as long as the
/// room between arrows allows (up to twice that on larger faces), times the length of its vector.
/// The first field's are centred on their places; the second's have the same tails. Cost: O(places
/// up to the finest level that shows).
ArrowSelection select_arrows(const ArrowSurface& surface, const Camera& camera,
                             const ArrowStyle& style, float scale,
                             std::span<const glm::vec3> primary,
                             std::span<const glm::vec3> secondary);

}  // namespace geotherm::engine
