// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/mesh_report.h"
#include "solver/geometry/clean_faces.h"

namespace geotherm {

/// summarize_mesh() where the mesh's clean faces are known.
MeshSummary summarize_clean_faces(const TriangleMesh& mesh, const CleanFaces& clean, int threads);

}  // namespace geotherm
