// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geotherm/progress.h"
#include "solver/polyhedral/propagation.h"
#include "solver/polyhedral/wave_front.h"

namespace geotherm {

/// Directions of a source point as a wave sees them.
struct WaveStart {
  /// A face at the source: the direction of a line in its layout is turn + a, or minus where
  /// mirrored; a is its angle from `along`, no less than -pi.
  struct Face {
    Index face;
    Eigen::Vector2d from, along;  ///< the source, in the layout
    StartDirections::Turn turn;
  };
  std::vector<Face> faces;
  double period = 0;          ///< directions that differ by it are one; 0: none do
  std::vector<double> known;  ///< V: directions that are known already, no number elsewhere
};

/// Lengths that differ by less than this share are one to waves with so many samples an edge.
double close_share(int samples);

/// Directions of vertices, and how many of these hang on which of two ways is the shorter, which a
/// wave cannot tell: their lengths differ by less than close_share().
struct WaveDirections {
  std::vector<double> of;  ///< V, no number where there is no path
  Index in_doubt = 0;
};

/// The directions in which the paths of a wave that has run leave its source, one point. Behind
/// each edge the line to a target is that of the wave fitted there, and its direction lies between
/// those of the edge's ends and samples as the line does. By ascending distance. Cost: that of the
/// wave, and a sort.
WaveDirections wave_directions(const WaveSurface& surface, const WaveTables& tables,
                               const WaveFront& front, int samples, const WaveStart& start);

}  // namespace geotherm
