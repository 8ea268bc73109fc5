// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/distance_method.h"
#include "solver/accuracy/distance_bounds.h"
#include "solver/wave/wave_surface.h"

namespace geotherm {

/// Fills in the quality figures that waves know: how far a source vertex is above its offset (0 but
/// for round-off: its value is a minimum that starts there), the slope, and the bounds of
/// distance_bounds.h, with their warnings. `result.distances` are still in units of the intrinsic
/// mesh, with those of inserted vertices at the end. Cost: O(F).
void assess_waves(MethodKind method, const WaveSurface& surface, const SourceSet& sources,
                  const SourceSeeds& seeds, DistanceResult& result);

}  // namespace geotherm
