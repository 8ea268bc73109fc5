// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace geotherm::app {

/// Name and description of the backends of this build, one a line, the default first.
std::string list_backends();

/// Name, number of faces and description of the bundled models, one a line.
std::string list_models();

}  // namespace geotherm::app
