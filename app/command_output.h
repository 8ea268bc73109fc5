// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geotherm/error.h"

namespace geotherm::app {

/// What a command that has done its work hands to whoever called it; nothing has been printed.
struct CommandOutput {
  std::string text;  ///< for standard output
  std::vector<std::string> warnings;
  std::vector<std::string> made;  ///< new files, to be removed when the text cannot be printed
  std::string note = {};          ///< a line for standard error that is no warning; empty: none
  /// Why the work counts as failed although there is something to print.
  std::optional<Error> failure = {};
};

}  // namespace geotherm::app
