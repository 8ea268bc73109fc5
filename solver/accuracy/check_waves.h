// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/distance_method.h"
#include "solver/accuracy/distance_bounds.h"
#include "solver/polyhedral/wave_surface.h"

namespace geotherm {

/// What faces say of distances, by area.
struct SlopeSums {
  double error = 0;  ///< of | |grad d| - 1 |
  double area = 0;   ///< twice the faces' own
  double mean() const { return area > 0 ? error / area : 0; }
};
/// Over the faces whose corners are all reached; edges that are too steep are counted.
/// `distances`: of vertices, in the units of the mesh. `some`: a flag for each face that counts, or
/// empty. Cost: O(F).
SlopeSums sum_slopes(const IntrinsicMesh& mesh, std::span<const double> distances,
                     SteepSides& steep, std::span<const char> some = {});

/// Fills in the quality figures that waves know: how far a source vertex is above its offset (0 but
/// for round-off: its value is a minimum that starts there), the slope, and the bounds of
/// distance_bounds.h, with their warnings. `result.distances` are still in units of the intrinsic
/// mesh, with those of inserted vertices at the end. Cost: O(F).
void assess_waves(MethodKind method, const WaveSurface& surface, const SourceSet& sources,
                  const SourceSeeds& seeds, DistanceResult& result);

}  // namespace geotherm
