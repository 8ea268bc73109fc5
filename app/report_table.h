// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/session/answer.h"

namespace geotherm::app {

/// What `solve` shows to people.
std::string solve_table(const Answer& figures);

/// What `info` shows to people.
std::string info_table(const Model& model, const MeshReport& mesh);

}  // namespace geotherm::app
