// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "solver/path/path_surface.h"

namespace geotherm {

/// A function whose streamlines are followed downhill: linear on each face.
struct DescentField {
  std::span<const double> values;  ///< V, file order
  /// Values are ln u, and the function is -u: its streamlines are those of the heat method's
  /// X = -grad u / |grad u| backwards, followed also where u itself underflows.
  bool log_heat = false;
};

/// Where the steepest way down leads from a point: to a vertex in a straight line where there is
/// one, else across the face, so that the point's weights there change in proportion to `rates`.
struct Descent {
  double slope = 0;  ///< > 0, or nothing leads down
  Index face = kNoIndex;
  Index vertex = kNoIndex;
  std::array<double, 3> rates{};
};

/// The steepest way down from a point of the surface: into a face that holds it, along its edge
/// where the faces there lead into the edge, or along an edge of its vertex.
Descent steepest_descent(const PathSurface& surface, const DescentField& field,
                         const SurfacePoint& point);

}  // namespace geotherm
