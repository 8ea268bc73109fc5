// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
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

}  // namespace geotherm::engine
