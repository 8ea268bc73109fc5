// SPDX-License-Identifier: MIT
#include "solver/wave/judge_wave.h"

#include <algorithm>

#include "solver/wave/eikonal.h"

namespace geotherm {

void judge_wave(MethodKind method, const WaveSurface& surface, const SourceSet& sources,
                const SourceSeeds& seeds, DistanceResult& result) {
  double above = 0;
  for (const auto& vertex : seeds.vertices) {
    above = std::max(above, result.distances[vertex.vertex] - vertex.offset);
  }
  result.quality.max_source_distance = above * surface.base.mean_edge;
  const BoundTolerance tolerance = bound_tolerance(method);
  SteepSides steep(tolerance);
  result.quality.eikonal_error_mean =
      eikonal_error_mean(surface.base.intrinsic, result.distances, steep);
  steep.write_to(result.quality);
  check_straight_lines(surface.base, sources, surface.base.mean_edge, tolerance, 1, result);
  add_bound_warnings(method, result);
}

}  // namespace geotherm
