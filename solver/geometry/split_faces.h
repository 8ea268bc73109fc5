// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "solver/geometry/edit.h"
#include "solver/geometry/intrinsic_mesh.h"

namespace geotherm {

/// Puts a new vertex on an edge, `share` (between 0 and 1) of the way along `side`; the one or two
/// faces at the edge are cut in two and stay flat, so that the surface stays what it is. The edits,
/// one a face, are appended. Returns the sides of the new faces opposite the vertex, whose edges
/// may no longer be Delaunay. Precondition: the two sides of the edge belong to different faces.
/// Cost: O(1).
std::vector<Side> split_side(IntrinsicMesh& mesh, Side side, double share, Index vertex,
                             std::vector<Edit>& edits);

/// The same within a face, at these barycentric weights, all above 0: the face is cut in three.
std::vector<Side> split_face(IntrinsicMesh& mesh, Index face, const std::array<double, 3>& weights,
                             Index vertex, std::vector<Edit>& edits);

}  // namespace geotherm
