// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/solve_figures.h"

namespace geotherm::app {

/// What `solve` shows to people.
std::string solve_table(const SolveFigures& figures);

/// What `info` shows to people.
std::string info_table(const Model& model, const MeshReport& mesh);

}  // namespace geotherm::app
