// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/sources.h"

namespace geotherm {

class PathSurface;

namespace app {

/// Joins points across the faces of one mesh, and keeps what it joined last, so that a curve that
/// goes on, as one that is painted does, costs its new pieces alone.
class CurveJoiner {
 public:
  explicit CurveJoiner(std::shared_ptr<const TriangleMesh> mesh) : mesh_(std::move(mesh)) {}

  /// The points joined by lines that are as straight as the surface lets them be: each is pulled
  /// tight within the fewest faces between two points, and led past vertices where that makes it
  /// shorter. Points that are one make a curve of no length, without segments.
  /// Errors: kBadInput (a point that is not on the mesh; no way across edges from one to the next),
  /// kBudgetEnded. Cost: O(F) the first time; for each two points that the last curve does not
  /// begin with as well, the faces nearer than the second.
  Result<std::vector<FaceSegment>> join(const std::vector<SurfacePoint>& points);

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const PathSurface> surface_;  ///< from the first curve on
  std::vector<SurfacePoint> points_;            ///< of the last curve, as far as they were joined
  std::vector<std::size_t> ends_;               ///< how many segments lead to each of them
  std::vector<FaceSegment> segments_;
};

}  // namespace app
}  // namespace geotherm
