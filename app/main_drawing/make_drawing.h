// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "app/drawing.h"

namespace geotherm::app {

/// What this build draws with. Opens nothing yet.
std::unique_ptr<Drawing> make_drawing();

}  // namespace geotherm::app
