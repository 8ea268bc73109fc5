// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "solver/core/result.h"

namespace geotherm::app {

/// Runs the command that `arguments` (without the program's name) ask for; output to standard
/// output and error. Returns the program's exit code: 0 done, 1 the work failed, 2 the command line
/// is wrong.
int run_command_line(std::vector<std::string> arguments);

/// 1 or 2.
int exit_code(ErrorCode code);

}  // namespace geotherm::app
