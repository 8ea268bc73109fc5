// SPDX-License-Identifier: MIT
#pragma once

#include "solver/method/distance_result.h"
#include "solver/method/method_kind.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// Fills in the quality figures that waves know: how far a source vertex is above its offset (0 but
/// for round-off: its value is a minimum that starts there), the slope, and the bounds of
/// distance_bounds.h, with their warnings. `result.distances` are still in units of the intrinsic
/// mesh, with those of inserted vertices at the end. Cost: O(F).
void judge_wave(MethodKind method, const WaveSurface& surface, const SourceSet& sources,
                const SourceSeeds& seeds, DistanceResult& result);

}  // namespace geotherm
