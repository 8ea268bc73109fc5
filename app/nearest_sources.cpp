// SPDX-License-Identifier: MIT
#include "app/nearest_sources.h"

#include <cmath>
#include <utility>

#include "solver/core/text.h"

namespace geotherm::app {

Result<std::vector<Index>> nearest_sources(const std::shared_ptr<const TriangleMesh>& mesh,
                                           const SourceSet& sources,
                                           std::span<const double> distances, int threads,
                                           const Progress& progress) {
  if (source_groups(sources).count == 1) {
    std::vector<Index> only(distances.size(), kNoIndex);
    for (std::size_t v = 0; v < only.size(); ++v) {
      if (std::isfinite(distances[v])) only[v] = 0;
    }
    return only;
  }
  MethodOptions options;
  options.method = MethodKind::kWavefront;
  options.threads = threads;
  const auto method = build_method(mesh, options, part_of(progress, 0.0, 0.5));
  if (!method) return method.error();
  auto result =
      (*method)->solve(sources, {.quality = false, .nearest = true}, part_of(progress, 0.5, 1.0));
  if (!result) return result.error();
  return std::move(result->nearest_source);
}

bool holds_mesh(const std::string& path) {
  const std::string extension = io::file_extension(path);
  return extension == ".ply" || extension == ".vtp";
}

std::vector<Region> regions_of(const SourceSet& sources, std::span<const Index> nearest) {
  const SourceGroups groups = source_groups(sources);
  std::vector<Region> regions(static_cast<std::size_t>(groups.count));
  for (Index label = 0; label < groups.count; ++label) regions[label].label = label;
  for (std::size_t i = 0; i < sources.points.size(); ++i) {
    Region& region = regions[groups.of_point[i]];
    if (!region.point) region.point = sources.points[i];
  }
  for (const Index group : groups.of_edge) ++regions[group].edges;
  for (const Index group : nearest) {
    if (group != kNoIndex) ++regions[group].vertices;
  }
  return regions;
}

}  // namespace geotherm::app
