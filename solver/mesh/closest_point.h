// SPDX-License-Identifier: MIT
#pragma once

#include "solver/core/result.h"
#include "solver/mesh/surface_point.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

struct ClosestPoint {
  SurfacePoint point;   ///< a vertex where the closest point is one, else weights in a face
  double distance = 0;  ///< straight line, model units
};

/// The point of the surface nearest to `query` (model units); the first face among equals. Faces
/// that repeat a corner are left out; faces without area count as the segments they are.
/// Errors: kBadInput (a coordinate that is not finite, no face but such with a repeated corner).
/// Cost: O(F), no index is built.
Result<ClosestPoint> closest_point(const TriangleMesh& mesh, const Vec3& query);

}  // namespace geotherm
