// SPDX-License-Identifier: MIT
#include "solver/accuracy/check_waves.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace geotherm {

SlopeSums sum_slopes(const IntrinsicMesh& mesh, std::span<const double> distances,
                     SteepSides& steep, std::span<const char> some) {
  SlopeSums sums;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (!some.empty() && !some[f]) continue;
    const auto [a, b, c] = mesh.faces[f];
    const double da = distances[a], db = distances[b] - da, dc = distances[c] - da;
    if (!std::isfinite(db) || !std::isfinite(dc)) continue;
    if (da == 0 && db == 0 && dc == 0) continue;  // sources alone: no distance rises here
    const FaceLayout layout = lay_out(mesh.lengths[f]);
    const double slope_x = db / layout.base;
    const double slope_y = (dc - slope_x * layout.x) / layout.height;
    const double twice_area = layout.base * layout.height;
    const double slope = std::hypot(slope_x, slope_y);
    sums.error += twice_area * std::abs(slope - 1);
    sums.area += twice_area;
    if (!steep.may_be_steep(slope)) continue;
    const double differences[3] = {db, dc - db, dc};
    for (int k = 0; k < 3; ++k) {
      const double length = mesh.lengths[f][k];
      if (!steep.is_steep(differences[k], length)) continue;
      const bool alone = mesh.twin[3 * static_cast<Side>(f) + k] == kNoSide;
      steep.add(differences[k], length, alone ? 1.0 : 0.5);
    }
  }
  return sums;
}

void assess_waves(MethodKind method, const WaveSurface& surface, const SourceSet& sources,
                  const SourceSeeds& seeds, DistanceResult& result) {
  double above = 0;
  for (const auto& vertex : seeds.vertices) {
    above = std::max(above, result.distances[vertex.vertex] - vertex.offset);
  }
  result.quality.max_source_distance = above * surface.base.length_unit();
  const BoundTolerance tolerance = bound_tolerance(method);
  SteepSides steep(tolerance);
  result.quality.eikonal_error_mean =
      sum_slopes(surface.base.intrinsic, result.distances, steep).mean();
  steep.write_to(result.quality);
  apply_straight_line_bound(surface.base, sources, surface.base.length_unit(), tolerance,
                            BelowLine::kKept, 1, result);
  add_bound_warnings(method, result);
}

}  // namespace geotherm
