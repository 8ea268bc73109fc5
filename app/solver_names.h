// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "geotherm/build_method.h"

namespace geotherm::app {

/// What `text` names, separated by commas: backends of the heat method, other methods, or `all` for
/// all backends; each once. The options are those of `base` otherwise. Errors: kNotAvailable, with
/// the names there are.
Result<std::vector<MethodOptions>> solvers_named(const std::string& text,
                                                 const MethodOptions& base);

}  // namespace geotherm::app
