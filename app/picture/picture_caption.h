// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "solver/heat/heat_method.h"

namespace geotherm::app {

/// "t = 0.0123, cholmod".
std::string method_caption(const HeatMethod& method);

/// "bunny, 4,000 faces, t = 0.0123, cholmod"; `method`: null without a solve.
std::string picture_caption(const std::string& model, Index faces, const HeatMethod* method);

}  // namespace geotherm::app
