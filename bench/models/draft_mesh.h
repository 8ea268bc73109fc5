// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "geotherm/types.h"

namespace geotherm::generate {

/// A mesh in the making: what TriangleMesh takes, still free to change.
struct DraftMesh {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
};

/// Brings the moved vertex `v` back onto the surface: from `target`, which lies near the surface,
/// to a point of it; `normal` is the mesh's unit normal at the vertex. Returns the vertex' old
/// place where it shall not move.
using Projection = std::function<Vec3(Index v, const Vec3& target, const Vec3& normal)>;

/// Evens out the triangles: every vertex moves along the surface towards the middle of its faces
/// (the mean of their centroids, weighted by area) and is projected; then the edges are flipped to
/// Delaunay. All vertices move at once: the result does not depend on their order.
void relax(DraftMesh& mesh, const Projection& project);

/// Moves the corners of the few bad triangles (an angle under 20 or over 125 degrees), which lie in
/// folds narrower than the triangles are wide, to the middle of their neighbours, a few times.
void smooth_slivers(DraftMesh& mesh);

}  // namespace geotherm::generate
