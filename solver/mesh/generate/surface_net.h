// SPDX-License-Identifier: MIT
#pragma once

#include "solver/mesh/generate/draft_mesh.h"
#include "solver/mesh/generate/sparse_field.h"

namespace geotherm::generate {

/// The zero surface of a sampled field by surface nets (Gibson 1998): a vertex in every cell that
/// the surface crosses, two triangles across every grid edge that it crosses.
///
/// The net is the boundary of a set of voxels (the points inside), which is a manifold exactly when
/// that set is well composed (Latecki 1997): no face and no cell of the grid where inside touches
/// inside only across a diagonal. Where it does, points just outside are first taken in, until it
/// does nowhere; the result is therefore always an oriented closed manifold. Small pieces are
/// dropped: what remains is the component with the most faces.
DraftMesh extract_surface(SparseField& field);

/// Keeps the connected component with the most faces (the first of equals), vertices in order.
DraftMesh largest_component(const DraftMesh& mesh);

}  // namespace geotherm::generate
