// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/overlay/overlay.h"
#include "engine/scene/camera.h"
#include "engine/scene/colour_map.h"

namespace geotherm::engine {

struct Tick {
  float position = 0;  ///< 0 at the bar's lower end, 1 at its upper end
  std::string label;
};

/// What a colour in the picture stands for.
struct Key {
  glm::vec3 colour{0};
  std::string label;
  std::optional<glm::vec3> rim{};    ///< about the stroke that shows the colour
  std::vector<glm::vec3> patches{};  ///< instead of a stroke: patches of several colours
};

/// What is written around the model; empty parts are left out.
struct Legend {
  bool bar = false;
  std::vector<glm::vec3> colours;  ///< of the bar from its lower end up, sRGB, 2 or more
  std::vector<float> lines;        ///< isolines on the bar: positions as of ticks
  std::vector<Tick> ticks;
  std::string title;  ///< over the bar: what the values are, and their unit
  /// One line along the lower edge; cut with an ellipsis where it is too long.
  std::string caption;
  std::vector<Key> keys;        ///< one a line in the upper left corner
  glm::vec3 ink{0};             ///< colour of letters and frames
  glm::vec4 paper{1, 1, 1, 0};  ///< under them, so that they can be read where the model lies there
  float scale = 1;              ///< of letters and bar; 1 suits a picture 720 pixels high
};

struct LegendLayout {
  Overlay overlay;
  Insets insets;  ///< what the legend takes of the picture's sides; 0 where it has nothing
};

/// Lays the legend out for a picture of this size. Letters grow with the smaller side of the
/// picture; ticks whose labels would touch are thinned out; a picture that is too small for a bar
/// or a caption has none. Cost: the glyphs' rasterisation, milliseconds.
LegendLayout lay_out(const Legend& legend, glm::vec2 extent);

}  // namespace geotherm::engine
