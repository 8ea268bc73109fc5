// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/explore/command.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// Second line of what the program writes. A shell that is given the file takes all that follows
/// for a text that it does not look into; geotherm skips the line.
inline constexpr const char* kInertLine = ": <<'commands of geotherm'";

/// The commands of a file. Errors: kBadFile: it cannot be read, and those of parse_script().
Result<std::vector<ScriptLine>> read_script(const std::string& path);

/// The files that a script asks to write, through the scripts that it runs as well, each once and
/// in their order. What cannot be read counts as empty: to run it is the error.
std::vector<std::string> files_written_by(const std::string& script);

}  // namespace geotherm::app
