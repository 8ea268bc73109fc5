// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/core/progress.h"
#include "solver/core/result.h"
#include "solver/method/distance_method.h"
#include "solver/path/path_surface.h"
#include "solver/path/surface_path.h"

namespace geotherm {

/// What a path follows.
enum class PathField {
  kGeodesic,  ///< nothing: it is the shortest that is found, and straight wherever it can be
  kDistance,  ///< -grad phi, the distance from its start, backwards from its end
  kHeat,      ///< X = -grad u / |grad u| of the heat method, likewise
};

/// geodesic | distance | heat. Errors: kNotAvailable, with the names there are.
std::string to_text(PathField field);
Result<PathField> parse_path_field(std::string_view text);
std::vector<std::string> path_field_names();

struct PathOptions {
  PathField field = PathField::kGeodesic;
  bool closed = false;  ///< goes on from the last point to the first
  /// A closed geodesic is held by its points; else these only say where it runs at first, and it
  /// is shortened all round (to one point, where it can be).
  bool hold_points = false;
};

struct FoundPath {
  SurfacePath path;
  std::vector<std::string> warnings;
};

/// Finds paths on one mesh. Immutable; several threads may ask at once.
class PathFinder {
 public:
  /// `method`: of the same mesh. The better it is, the surer a geodesic is the shortest of all
  /// (search_geodesic()): those of MethodKind::kWavefront will do. Cost: O(F).
  PathFinder(std::shared_ptr<const TriangleMesh> mesh,
             std::shared_ptr<const DistanceMethod> method);

  /// The path through two points or more, in order. The geodesic from a to b is that from b to a.
  /// Errors: kBadInput (fewer points, one that is not on the mesh, no way from one to the next, a
  /// heat field without the heat method), kOutOfMemory, those of DistanceMethod::solve() and
  /// shorten(). Shares of the progress do not fall.
  /// Cost: a query of the method for each piece, or two for a geodesic, and milliseconds.
  Result<FoundPath> find(std::span<const SurfacePoint> points, const PathOptions& options = {},
                         const Progress& progress = {}) const;

  const PathSurface& surface() const { return *surface_; }

 private:
  Result<FoundPath> through(std::span<const SurfacePoint> points, const PathOptions& options,
                            const Progress& progress) const;
  Result<FoundPath> piece(const SurfacePoint& from, const SurfacePoint& to, PathField field,
                          const Progress& progress) const;
  Result<FoundPath> streamline(const SurfacePoint& from, const SurfacePoint& to, PathField field,
                               const Progress& progress) const;
  Result<DistanceResult> distances(const SurfacePoint& source, bool heat,
                                   const Progress& progress) const;
  Result<FoundPath> geodesic(const SurfacePoint& from, const SurfacePoint& to,
                             const Progress& progress) const;

  std::shared_ptr<const PathSurface> surface_;
  std::shared_ptr<const DistanceMethod> method_;
};

}  // namespace geotherm
