// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::app {

/// A command on one line of UTF-8 as it can be given to a shell (bash, zsh) again: words quoted
/// where they need it, control characters and bytes that are no UTF-8 as $'\012'.
std::string shell_command(std::string program, const std::vector<std::string>& words);

}  // namespace geotherm::app
