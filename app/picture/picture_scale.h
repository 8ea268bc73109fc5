// SPDX-License-Identifier: MIT
#pragma once

#include "app/picture/picture_data.h"
#include "app/picture/picture_settings.h"
#include "app/picture/ticks.h"

namespace geotherm::app {

/// What the colours of a picture stand for, in model units: the settings with the data's say where
/// they leave it open.
struct PictureScale {
  double min = 0, max = 1;  ///< at the ends of the colour map; min < max
  double spacing = 0;       ///< of isolines; 0: none
  bool coloured = false;    ///< the view shows distances and there are some above 0
  bool bar = false;         ///< there is something to read off a colour bar, and it is wanted
  std::string colour_map;   ///< the one that is drawn
  Ticks ticks;              ///< of the bar
};

/// The settings' map, or a diverging one where values have both signs and it is none.
std::string colour_map_of(const PictureData& data, const PictureSettings& settings);

/// Whether a view is about where distance is 0; the others show the mesh alone.
bool needs_sources(View view);

/// Whether a view paints values of vertices by the colour map.
bool maps_values(View view);

/// Whether a picture shows which source is the nearest: the view is to, and it is known.
bool shows_regions(const PictureData& data, const PictureSettings& settings);

PictureScale picture_scale(const PictureData& data, const PictureSettings& settings);

}  // namespace geotherm::app
