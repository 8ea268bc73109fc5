// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "app/viewer_window.h"

namespace geotherm::app {

/// The window of this build. Opens nothing yet.
std::unique_ptr<ViewerWindow> make_window();

}  // namespace geotherm::app
