// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/scene.h"

namespace geotherm::engine {

/// A surface with few faces that stands for one with many while the picture moves: vertices that
/// share a cell of a grid become one, in their middle.
struct CoarseSurface {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<Openness> openness;        ///< by vertex; empty: all is open
  std::vector<std::uint32_t> of_vertex;  ///< by vertex of the model: what it became
  std::vector<std::uint32_t> example;    ///< by vertex: one of the model that became it
  std::vector<std::uint32_t> origin;     ///< by face: the model's face that it is made of

  /// Means of the values that became one vertex; kNoValue where none of them has one.
  std::vector<float> means(std::span<const float> values) const;
};

/// About as many faces as `wanted`. Faces whose corners meet, and all but one of those that lie on
/// each other, are left out. Precondition: wanted > 0. Cost: O(V log V + F).
CoarseSurface coarse_surface(const SurfaceGeometry& geometry, std::size_t wanted);

}  // namespace geotherm::engine
