// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "geotherm/sources.h"

namespace geotherm {

/// Two points, and the distances of all vertices from each (V, file order, model units).
struct GeodesicEnds {
  SurfacePoint from, to;
  std::span<const double> from_distances, to_distances;
};

}  // namespace geotherm
