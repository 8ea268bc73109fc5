// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geotherm/build_method.h"

// Which source is the nearest: geodesic Voronoi cells.
namespace geotherm::app {

/// V: group (source_groups()) of the nearest source by the wavefront method, kNoIndex where none
/// can be. `distances`: finite where a source can be. Errors: those of build_method() and its
/// queries.
Result<std::vector<Index>> nearest_sources(const std::shared_ptr<const TriangleMesh>& mesh,
                                           const SourceSet& sources,
                                           std::span<const double> distances, int threads,
                                           const Progress& progress);

/// Whether a file of distances holds the mesh as well, so that a property can be added to it
/// without harm: .ply and .vtp.
bool holds_mesh(const std::string& path);

/// One source with what it is nearest to.
struct Region {
  Index label = 0;                    ///< the group
  std::optional<SurfacePoint> point;  ///< the first of the group, where it has one
  Index edges = 0;                    ///< of the group
  Index vertices = 0;                 ///< that it is nearest to
};

/// One for each group, ascending.
std::vector<Region> regions_of(const SourceSet& sources, std::span<const Index> nearest);

}  // namespace geotherm::app
