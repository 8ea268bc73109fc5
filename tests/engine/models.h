// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "engine/scene/scene.h"
#include "tests/support/shapes.h"

namespace geotherm::test {

/// A model in scene space that owns its arrays.
struct Model {
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;

  engine::SurfaceGeometry geometry() const { return {positions, faces}; }
  /// One value a vertex.
  std::vector<float> values(const std::function<float(const glm::vec3&)>& of) const;
};

Model model_of(const Draft& draft);
/// Moved and scaled so that it lies within radius 1 of the origin.
Model fitted_model(std::span<const Vec3> positions, std::span<const Face> faces);

/// 1.6 x 1.2 about the origin in the plane z = 0, nx x ny cells.
Model plane_model(Index nx, Index ny);
/// The same rectangle, irregularly cut.
Model irregular_plane_model(Index n);
/// About the origin, each side two triangles with vertices that it shares with its neighbours.
Model cube_model(float half_side);
/// A square in a plane z = constant.
Model square_model(float half_side, float z);

void append(Model& model, const Model& other);

}  // namespace geotherm::test
