// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "app/picture/picture_data.h"

namespace geotherm::app {

/// The surface of a picture for files that others draw: vertices by those of the data, repeated
/// where faces meet sharply, so that each has one normal, that of pictures. Vertices without a face
/// are left out.
struct SceneMesh {
  std::vector<glm::vec3> positions;                 ///< scene space
  std::vector<glm::vec3> normals;                   ///< unit
  std::vector<std::uint32_t> openness;              ///< two a vertex, 255 times that of each side
  std::vector<std::uint32_t> origin;                ///< the data's vertex of each, ascending
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< those of the data, in their order
};

/// Cost: O(F log F).
SceneMesh scene_mesh(const PictureData& data);

/// The same with three vertices for each face alone, which may then have values of its own.
SceneMesh separate_corners(const SceneMesh& mesh);

}  // namespace geotherm::app
