// SPDX-License-Identifier: MIT
#include "solver/method/marching_method.h"

#include <cmath>
#include <utility>

#include "solver/core/stopwatch.h"
#include "solver/geometry/intrinsic_surface.h"
#include "solver/method/reach.h"

namespace geotherm {
namespace {

Error bad_space_source(std::string message) { return {ErrorCode::kBadInput, std::move(message)}; }

}  // namespace

Result<void> check_space_sources(const SourceSet& sources, const std::string& instead) {
  if (sources.empty()) return bad_space_source("there is no source");
  if (!sources.edges.empty()) {
    return bad_space_source("curves of mesh edges are sources of triangle meshes alone");
  }
  if (!sources.segments.empty()) {
    return bad_space_source("curves across faces are sources of triangle meshes alone");
  }
  const auto in_face = [](const SurfacePoint& point) { return !point.is_vertex(); };
  if (std::ranges::any_of(sources.points, in_face)) {
    return bad_space_source("points in faces are sources of triangle meshes alone; give " +
                            instead);
  }
  return check_offsets(sources, 1, "offsets are lengths, finite and not negative");
}

Result<void> check_weights(std::span<const double> weights, std::size_t corners,
                           const std::string& cell) {
  double sum = 0;
  bool valid = weights.size() == corners;
  for (const double weight : weights) {
    valid = valid && weight >= 0;
    sum += weight;
  }
  constexpr double kOfOne = 1e-9;
  if (valid && std::abs(sum - 1) <= kOfOne) return {};
  return bad_space_source("the source in " + cell + " needs " + std::to_string(corners) +
                          " weights that are not negative and sum to 1");
}

Result<std::vector<DistanceResult>> MarchingMethod::solve_each(std::span<const SourceSet> sets,
                                                               const QueryOptions& query,
                                                               const Progress& progress) const {
  if (auto valid = check_reach(query.reach, vertices_); !valid) return valid.error();
  const auto one = [&](const SourceSet& sources, const Progress& part) -> Result<DistanceResult> {
    const Stopwatch watch;
    auto marched = march(sources, part);
    if (!marched) return marched.error();
    DistanceResult result;
    result.distances = std::move(marched->distances);
    if (query.nearest) result.nearest_source = std::move(marched->nearest);
    result.quality.reached_vertices = count_reached(result.distances);
    result.timing.query = watch.milliseconds();
    if (query.quality) result.quality.eikonal_error_mean = eikonal_error(result.distances);
    keep_reach(query.reach, result);
    return result;
  };
  return solve_sets(sets, threads_, progress, one);
}

}  // namespace geotherm
