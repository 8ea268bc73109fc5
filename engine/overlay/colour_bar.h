// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/overlay/overlay.h"

// The colour bar of a legend: a column at the right side, or a row along the lower edge.
namespace geotherm::engine {

/// Sizes that follow from the picture's, in whole pixels.
struct Measures {
  float line;    ///< height of a line of text that is asked for
  float margin;  ///< to the picture's sides
  float stroke;  ///< thickness of frames and ticks
};

/// Something to write on, a little larger than what will be written.
void draw_paper(const Legend& legend, glm::vec2 min, glm::vec2 max, float margin, Overlay& overlay);

/// What the bar takes of the picture's sides, and its corners; nothing, all 0, where it has no
/// room.
struct BarPlace {
  Insets insets;
  glm::vec2 min{0}, max{0};
};

/// Draws the bar between the lines `top` and `bottom` where it leaves room to the model: first as
/// the picture's shape suggests, else the other way.
BarPlace draw_colour_bar(const Legend& legend, const Measures& m, glm::vec2 extent, float top,
                         float bottom, Overlay& overlay);

}  // namespace geotherm::engine
