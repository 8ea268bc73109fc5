// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/cli/viewer_window.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// Runs the command that `arguments` (without the program's name) ask for; output to standard
/// output and error. Returns the program's exit code: 0 done, 1 the work failed, 2 the command line
/// is wrong. `drawing`, `window`: what commands with pictures draw with, and where.
int run_command_line(std::vector<std::string> arguments, Drawing& drawing, ViewerWindow& window);

/// 1 or 2.
int exit_code(ErrorCode code);

}  // namespace geotherm::app
