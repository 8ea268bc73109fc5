// SPDX-License-Identifier: MIT
#pragma once

#include "app/drawing.h"
#include "engine/device.h"

namespace geotherm::app {

DrawingDevice device_in_our_words(const engine::DeviceInfo& info);

}  // namespace geotherm::app
