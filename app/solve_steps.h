// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/build_method.h"
#include "geotherm/error.h"
#include "geotherm/mesh.h"
#include "geotherm/mesh_report.h"

// What every solve of a model has to see to, in one command or in a session.
namespace geotherm::app {

/// What the library finds wrong with a mesh is a failure of the work, not of the command line.
Error about_model(const std::string& name, const Error& error);

/// Whether the pinned vertex, where one is named, is on the mesh.
Result<void> check_pin(const Constraint& constraint, const TriangleMesh& mesh);

/// One sentence for each reason why `unreached` vertices have no distance.
std::vector<std::string> unreached_notes(const MeshSummary& mesh, Index unreached);

}  // namespace geotherm::app
