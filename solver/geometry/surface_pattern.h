// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "solver/geometry/intrinsic_mesh.h"
#include "solver/linear/symmetric_pattern.h"
#include "solver/mesh/connectivity.h"

namespace geotherm {

/// The pattern of any operator on a surface, which is pattern_of_faces() of its faces: from each
/// vertex the sides that begin there lead to its neighbours, and those that end there and have no
/// twin. `corners`: of mesh.faces. `used`: the vertices that faces use, ascending; `local`: for
/// every vertex its number among them. Cost: O(F), by all threads.
SymmetricPattern surface_pattern(const IntrinsicMesh& mesh, const CornerTable& corners,
                                 std::span<const Index> used, std::span<const Index> local,
                                 int threads);

}  // namespace geotherm
