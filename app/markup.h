// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace geotherm::app {

/// Text for HTML, SVG and XML: &, <, > and double quotes as entities, and '?' for what these may
/// not hold (control characters, bytes that are no UTF-8).
std::string escaped(std::string_view text);

}  // namespace geotherm::app
