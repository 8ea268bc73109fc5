// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::app {

/// What a command that has done its work hands to whoever called it; nothing has been printed.
struct CommandOutput {
  std::string text;  ///< for standard output
  std::vector<std::string> warnings;
  std::vector<std::string> made;  ///< new files, to be removed when the text cannot be printed
};

}  // namespace geotherm::app
