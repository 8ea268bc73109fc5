// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace geotherm::engine {

/// Where arrows may stand: all faces, ordered so that every prefix covers the surface evenly.
///
/// Level l keeps its places at least kCoarsest * 2^(-l/2) apart (on one side of the surface) and
/// contains the levels before it, so that arrows stay where they are while one zooms in and others
/// appear between them. Dart throwing over the levels until a quarter of the faces stands; the rest
/// is one last level.
class ArrowPlaces {
 public:
  static constexpr float kCoarsest = 1.0F;  ///< scene units

  ArrowPlaces() = default;
  explicit ArrowPlaces(const SurfaceGeometry& geometry);  ///< cost: O(F log F)

  struct Place {
    glm::vec3 centre;
    std::uint32_t face;
    glm::vec3 normal;  ///< unit
    float face_size;   ///< square root of the face's area
    float spacing;     ///< its neighbours of the same level are at least this far away
  };
  const std::vector<Place>& places() const { return places_; }

 private:
  std::vector<Place> places_;
};

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
