// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/mesh/surface_point.h"
#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// Cuts every face into four at the midpoints of its edges, `times` times: the surface stays the
/// same, and so do the numbers of its vertices, which come first. Faces that share an edge, two or
/// more, share its midpoint. The parts of face f are 4^times f, ... (subdivided_point()). A face
/// that repeats a corner has no inside and becomes itself four times.
///
/// Errors: kBadInput (times negative; more faces than can be numbered), kOutOfMemory, each with
/// the number of faces. Cost: O(4^times F); each time the mean edge halves.
Result<TriangleMesh> subdivide(const TriangleMesh& mesh, int times);

/// The same point in the subdivided mesh; a vertex stays one. Weights are halved and doubled alone,
/// so that points on edges stay on edges. Preconditions: weights >= 0 that sum to 1, a face that
/// repeats no corner.
SurfacePoint subdivided_point(SurfacePoint point, int times);

/// The vertices along side k of face f of the mesh that became `faces`, from corner k to the next:
/// 2^times + 1. Precondition: the face repeats no corner.
std::vector<Index> subdivided_side(std::span<const Face> faces, Index f, int k, int times);

}  // namespace geotherm
