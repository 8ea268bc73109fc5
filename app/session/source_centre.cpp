// SPDX-License-Identifier: MIT
#include "app/session/source_centre.h"

#include <algorithm>
#include <array>

#include "app/session/model_solver.h"
#include "app/session/wording.h"

namespace geotherm::app {

Result<std::vector<SurfacePath>> ways_from(const Model& model, const Centre& centre,
                                           std::span<const SurfacePoint> points, int threads,
                                           const Progress& progress) {
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  options.threads = threads;
  ModelSolver solver(model);
  const auto ready = solver.prepare(options, part_of(progress, 0, 0.3));
  if (!ready) return ready.error();
  const PathFinder finder(model.mesh, ready->method);
  std::vector<SurfacePath> ways;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(centre.distances[i] > 0)) continue;
    const std::array<SurfacePoint, 2> ends = {centre.point, points[i]};
    const double begun = 0.3 + 0.7 * static_cast<double>(i) / static_cast<double>(points.size());
    auto found = finder.find(ends, {}, part_of(progress, begun, begun));
    if (!found) return about_model(model.name, found.error());
    ways.push_back(std::move(found->path));
  }
  return ways;
}

Result<SourceCentre> centre_of_sources(const Model& model, const SourceSet& sources,
                                       CentreKind kind, int threads, const Progress& progress) {
  if (auto surface = refuse_space(model, "centres are"); !surface) return surface.error();
  const bool has_curves = !sources.edges.empty() || !sources.segments.empty();
  const bool has_offsets = std::ranges::any_of(sources.offsets, [](double o) { return o != 0; });
  if (has_curves || has_offsets) {
    return Error{ErrorCode::kBadInput,
                 "a centre is of points, and some sources " +
                     std::string(has_curves ? "are curves" : "have offsets"),
                 {"choose vertices or points in faces alone"}};
  }
  auto centres = find_centres(model.mesh, sources.points, {},
                              {.kind = kind, .method = MethodKind::kWavefront, .threads = threads},
                              part_of(progress, 0, 0.7));
  if (!centres) return about_model(model.name, centres.error());
  auto ways =
      ways_from(model, centres->found.front(), sources.points, threads, part_of(progress, 0.7, 1));
  if (!ways) return ways.error();
  return SourceCentre{kind, *std::move(centres), *std::move(ways)};
}

}  // namespace geotherm::app
