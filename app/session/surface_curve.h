// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/sources.h"

namespace geotherm::app {

/// The points joined across faces by lines that are as straight as the surface lets them be: each
/// is pulled tight within the fewest faces between two points, and led past vertices where that
/// makes it shorter. Points that are one make a curve of no length, without segments.
/// Errors: kBadInput (a point that is not on the mesh; no way across edges from one to the next),
/// kBudgetEnded. Cost: O(F), and for each two points the faces nearer than the second.
Result<std::vector<FaceSegment>> join_across_faces(std::shared_ptr<const TriangleMesh> mesh,
                                                   const std::vector<SurfacePoint>& points);

}  // namespace geotherm::app
