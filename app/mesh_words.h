// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "solver/geometry/mesh_report.h"

namespace geotherm::app {

/// "2,002 vertices, 4,000 faces, 1 component, no boundary".
std::string mesh_in_words(const MeshReport& mesh);

/// What a user should know before trusting distances on the mesh, one sentence each.
std::vector<std::string> mesh_warnings(const MeshReport& mesh);

}  // namespace geotherm::app
