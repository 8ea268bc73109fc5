// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::app {

/// Wall time since the system started this process, milliseconds; 0 where it does not say.
double process_milliseconds();

}  // namespace geotherm::app
