// SPDX-License-Identifier: MIT
#pragma once

#include "solver/geometry/clean_faces.h"
#include "solver/geometry/mesh_report.h"

namespace geotherm {

/// summarize_mesh() where the mesh's clean faces are known.
MeshSummary summarize_clean_faces(const TriangleMesh& mesh, const CleanFaces& clean, int threads);

}  // namespace geotherm
