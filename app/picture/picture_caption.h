// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "geotherm/distance_method.h"

namespace geotherm::app {

/// "bunny, 4,000 faces, t = 0.0123, cholmod"; `method`: null without a solve.
std::string picture_caption(const std::string& model, Index faces, const DistanceMethod* method);

}  // namespace geotherm::app
