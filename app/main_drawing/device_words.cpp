// SPDX-License-Identifier: MIT
#include "app/main_drawing/device_words.h"

namespace geotherm::app {

DrawingDevice device_in_our_words(const engine::DeviceInfo& info) {
  DrawingDevice device;
  device.name = info.name;
  device.kind = info.kind;
  device.driver = info.driver;
  device.api = "Vulkan " + std::to_string(info.api_major) + "." + std::to_string(info.api_minor) +
               "." + std::to_string(info.api_patch);
  device.memory_mb = static_cast<double>(info.memory) / (1024.0 * 1024.0);
  device.software = info.software;
  device.chosen = info.chosen;
  device.lacks = info.lacks;
  return device;
}

}  // namespace geotherm::app
