// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "geotherm/error.h"

namespace geotherm {

/// Writes `bytes` beside `path` and renames: `path` is there whole or not at all. "-" is standard
/// output. Errors (kBadFile) carry the path and the system's reason; the temporary is removed.
Result<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace geotherm
