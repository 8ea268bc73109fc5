// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "solver/geometry/operator_mesh.h"

namespace geotherm {

/// Faces, their layouts, ranges, corners and the lower triangle of the pattern, from those of an
/// earlier mesh that differs in few places: `changes` is not empty. Faces that have not changed
/// stay in order, and those that have get their places among them. Cost: O(changes), and a copy of
/// the rest.
void merge_faces(const OperatorMesh& earlier, const IntrinsicMesh& mesh,
                 const OperatorChanges& changes, std::span<const Index> row_of_vertex, int threads,
                 OperatorMesh& out);

}  // namespace geotherm
