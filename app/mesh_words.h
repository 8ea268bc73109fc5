// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/mesh_report.h"
#include "geotherm/options.h"
#include "solver/geometry/cracks.h"

namespace geotherm::app {

/// What `--laplacian auto` becomes on a mesh, and because of what.
struct LaplacianChoice {
  LaplacianKind kind;
  std::string why;
};
LaplacianChoice auto_laplacian(const MeshReport& mesh);

/// "31 vertices inserted (4 on the border) for 40 large faces and 3 obtuse border edges".
/// Precondition: there are some.
std::string refinement_in_words(const RefinementCounts& refinement);

/// "2,002 vertices, 4,000 faces, 1 component, no boundary".
std::string mesh_in_words(const MeshSummary& mesh);

/// What closes the cracks. Precondition: there are some.
std::string crack_note(const CrackReport& cracks);

/// What a user should know before trusting distances on the mesh, one sentence each.
std::vector<std::string> mesh_warnings(const MeshReport& mesh);

}  // namespace geotherm::app
