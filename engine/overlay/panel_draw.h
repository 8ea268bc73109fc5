// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace geotherm::engine {

/// One letter image for panels, 8-bit coverage; `version` changes with its content.
struct PanelFont {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
  std::uint64_t version = 0;
};

/// Triangles of panels, drawn over everything: the layout of ImDrawVert and ImDrawIdx.
struct PanelDraw {
  struct Vertex {
    glm::vec2 position;  ///< pixels from the top left corner of the target
    glm::vec2 uv;        ///< in the font's image
    /// sRGB and alpha, not multiplied in: red is the lowest byte, alpha the highest.
    std::uint32_t colour = 0;
  };
  struct Command {
    glm::vec4 clip;  ///< left, top, right, bottom, pixels
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t vertex_offset = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint16_t> indices;
  std::vector<Command> commands;
};

}  // namespace geotherm::engine
