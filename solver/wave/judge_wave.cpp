// SPDX-License-Identifier: MIT
#include "solver/wave/judge_wave.h"

#include <algorithm>

#include "solver/wave/eikonal.h"

namespace geotherm {

void judge_wave(const WaveSurface& surface, const SourceSeeds& seeds, DistanceResult& result) {
  double above = 0;
  for (const auto& vertex : seeds.vertices) {
    above = std::max(above, result.distances[vertex.vertex] - vertex.offset);
  }
  result.quality.max_source_distance = above * surface.base.mean_edge;
  result.quality.eikonal_error_mean = eikonal_error_mean(surface.base.intrinsic, result.distances);
}

}  // namespace geotherm
