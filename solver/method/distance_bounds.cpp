// SPDX-License-Identifier: MIT
#include "solver/method/distance_bounds.h"

#include <string>

#include "solver/core/number_text.h"
#include "solver/core/parallel.h"
#include "solver/method/straight_line.h"

namespace geotherm {
namespace {

/// What the vertices say.
struct LineFigures {
  Index reached = 0, below = 0;
  double most = 0;   ///< share of the straight line that is missing, of those below
  double reach = 0;  ///< straight line to the farthest vertex at distance 0

  void add(const LineFigures& other) {
    reached += other.reached;
    below += other.below;
    most = std::max(most, other.most);
    reach = std::max(reach, other.reach);
  }
};

std::string percent(double share) { return rounded_text(100 * share) + " %"; }

/// What to use instead of a method whose answer is wrong.
Hint remedy(MethodKind method) {
  switch (method) {
    case MethodKind::kHeat:
    case MethodKind::kFastMarching:
      return {"use ", SettingHint{"method", {"wavefront"}}};
    case MethodKind::kWavefront:
    case MethodKind::kWavefrontFine:
      return {"use ", SettingHint{"method", {"exact"}}};
    case MethodKind::kExact:
      break;
  }
  return {"look at what is wrong with the mesh"};
}

}  // namespace

BoundTolerance bound_tolerance(MethodKind method) {
  switch (method) {
    case MethodKind::kHeat:
      return {0.1, 2, 1, 0.1};
    case MethodKind::kFastMarching:
      return {0.05, 0.5, 0.5, 0.1};
    case MethodKind::kWavefront:
    case MethodKind::kWavefrontFine:
      return {0.05, 0.1, 0.5, 0.1};
    case MethodKind::kExact:
      break;
  }
  return {1e-6, 1e-6, 1e-6, 1e-6};
}

void check_straight_lines(const IntrinsicSurface& surface, const SourceSet& sources, double unit,
                          const BoundTolerance& tolerance, int threads, DistanceResult& result) {
  const StraightLine straight(*surface.mesh, sources, surface.mean_edge);
  const auto positions = surface.mesh->positions();
  const double to_edges = unit / surface.mean_edge;
  const double per_share = 1 / (1 - tolerance.line_share);
  const bool clamped = result.quality.clamped_vertices > 0;
  LineFigures all;
  for (const LineFigures& part : sums_of_blocks<LineFigures>(
           threads, std::ssize(positions), [&](std::int64_t begin, std::int64_t end) {
             LineFigures sum;
             Index hint = 0;
             for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end);
                  ++v) {
               const double distance = result.distances[v] * to_edges;
               if (!(distance < kUnreached)) continue;
               ++sum.reached;
               const double most = (distance + tolerance.line_edges) * per_share;
               const Vec3 place = straight.place(positions[v]);
               if (distance == 0 && clamped)
                 sum.reach = std::max(sum.reach, straight.length(place));
               if (straight.is_within(place, most, hint)) continue;
               const double line = straight.length(place);
               if (!(line > most && line < kUnreached)) continue;  // beyond the range of doubles
               ++sum.below;
               sum.most = std::max(sum.most, 1 - distance / line);
             }
             return sum;
           })) {
    all.add(part);
  }
  result.quality.reached_vertices = all.reached;
  result.quality.below_straight_line = all.below;
  result.quality.most_below_straight_line = all.most;
  result.quality.clamped_reach = all.reach / to_edges;
}

void add_bound_warnings(MethodKind method, DistanceResult& result) {
  const Quality& q = result.quality;
  if (q.below_straight_line > 0) {
    result.warnings.push_back(
        {"the distance of " +
             counted_text(static_cast<std::size_t>(q.below_straight_line), "vertex", "vertices") +
             " (" + percent(static_cast<double>(q.below_straight_line) / q.reached_vertices) +
             ") is below the straight line to the nearest source, by up to " +
             percent(q.most_below_straight_line) + " of it; it is wrong there by at least that",
         remedy(method)});
  }
  if (q.steep_edges > 0) {
    result.warnings.push_back(
        {"along " + counted_text(static_cast<std::size_t>(q.steep_edges), "edge", "edges") +
             " the distance differs by more than their length, by up to " +
             rounded_text(q.steepest_edge) + " times that; it is wrong around them",
         remedy(method)});
  }
}

}  // namespace geotherm
