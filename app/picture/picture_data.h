// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "solver/core/types.h"

namespace geotherm::app {

/// Value of a vertex that no source reaches.
inline constexpr float kNoPictureValue = -std::numeric_limits<float>::max();

/// A solved model made ready for drawing: floats in scene space, where the model lies within radius
/// 1 of the origin whatever its own units are.
struct PictureData {
  using Vector = std::array<float, 3>;

  std::vector<Vector> positions;                    ///< V
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< F, as in the file
  Vec3 centre = Vec3::Zero();  ///< model = centre + scene * model_per_scene
  double model_per_scene = 1;

  std::vector<float> values;  ///< V: distance / value_unit, or kNoPictureValue
  double value_unit = 1;      ///< model units; the largest distance, 1 if there is none above 0

  std::vector<Vector> heat_directions;     ///< F: X = -grad u / |grad u|; 0 where there is none
  std::vector<Vector> distance_gradients;  ///< F: grad phi, scaled for the view gradient-error
  struct Segment {
    Vector from, to;
  };
  std::vector<Segment> sources;  ///< points (both ends the same) and pieces of curves

  std::string caption;      ///< model, faces, t, backend
  std::string value_title;  ///< over the colour bar
};

}  // namespace geotherm::app
