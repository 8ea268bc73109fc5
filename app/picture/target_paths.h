// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/picture/picture_data.h"
#include "geotherm/build_method.h"
#include "geotherm/path.h"

// Paths from a point to the nearest source, for pictures and the viewer.
namespace geotherm::app {

struct TargetPath {
  PathField field = PathField::kGeodesic;
  SurfacePath path;  ///< from the source to the target
};

struct TargetPaths {
  std::vector<TargetPath> paths;  ///< geodesic, distance, and heat where the method is that
  std::vector<Warning> warnings;
};

/// The point of the source set that is nearest to `target`: a point, or one on a curve's edge.
/// `distances`: V, from the target. Offsets count. A point without vertex and face, where no source
/// is reached.
SurfacePoint nearest_source_point(const TriangleMesh& mesh, const SourceSet& sources,
                                  const SurfacePoint& target, std::span<const double> distances);

/// What finds paths on one mesh, ready for many targets. Immutable.
class TargetPathFinder {
 public:
  /// `near_exact`: for the geodesic and for which source is the nearest; `shown`: whose streamlines
  /// are followed. Both of the mesh. Cost: O(F).
  TargetPathFinder(const std::shared_ptr<const TriangleMesh>& mesh,
                   std::shared_ptr<const DistanceMethod> near_exact,
                   std::shared_ptr<const DistanceMethod> shown);

  /// The paths of a kind, none where the method has no such field. Errors: kBadInput (the target
  /// lies in a component without a source), those of PathFinder.
  Result<TargetPaths> find(const SourceSet& sources, const SurfacePoint& target,
                           PathKind kind = PathKind::kAll, const Progress& progress = {}) const;

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const DistanceMethod> near_exact_;
  bool heat_;
  PathFinder geodesics_, streamlines_;
};

/// Adds them as lines, each field in its colour.
void add_paths(PictureData& data, const TriangleMesh& mesh, std::span<const TargetPath> paths);

}  // namespace geotherm::app
