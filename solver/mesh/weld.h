// SPDX-License-Identifier: MIT
#pragma once

#include "solver/mesh/triangle_mesh.h"

namespace geotherm {

/// A mesh whose close vertices are one.
struct WeldedMesh {
  TriangleMesh mesh;  ///< as many vertices and faces, in the same order; TriangleMesh::same_as()
  Index merged = 0;   ///< vertices that another one stands for
};

/// Makes vertices one that are joined by steps of at most `distance` (model units; 0: equal
/// positions) from vertex to vertex, which closes cracks between faces. The lowest one stands for
/// all, at its place. Only vertices of faces with three different corners are merged. Faces that
/// collapse then repeat a corner, and are left out when the mesh is cleaned. Errors: kBadInput
/// (distance negative or not finite; every face collapses), kOutOfMemory. Cost: O(V log V).
Result<WeldedMesh> weld(const TriangleMesh& mesh, double distance);

}  // namespace geotherm
