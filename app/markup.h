// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace geotherm::app {

/// Text for HTML and SVG: &, <, > and double quotes as entities.
std::string escaped(std::string_view text);

}  // namespace geotherm::app
