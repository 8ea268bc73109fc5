// SPDX-License-Identifier: MIT
#pragma once

#include "solver/mesh/generate/draft_mesh.h"

namespace geotherm::generate {

/// Flips edges until each is Delaunay: the two angles that face it sum to at most pi. An edge stays
/// where the surface is folded too sharply around it or where the new edge exists already, so the
/// mesh stays an oriented manifold. Precondition: it is one. Returns the number of flips.
Index flip_to_delaunay(DraftMesh& mesh);

}  // namespace geotherm::generate
