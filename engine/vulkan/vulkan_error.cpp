// SPDX-License-Identifier: MIT
#include "engine/vulkan/vulkan_error.h"

namespace geotherm::engine {

Error error_of(vk::Result status, std::string_view what) {
  const std::string doing(what);
  switch (status) {
    case vk::Result::eErrorOutOfDeviceMemory:
      return {ErrorCode::kOutOfMemory,
              doing +
                  ": the device is out of memory; try a smaller picture, --samples 1 or a mesh "
                  "with fewer faces"};
    case vk::Result::eErrorOutOfHostMemory:
      return {ErrorCode::kOutOfMemory, doing + ": out of memory; try a smaller picture or mesh"};
    case vk::Result::eErrorDeviceLost:
      return {ErrorCode::kNoDevice,
              doing +
                  ": the device was lost (its driver has given up); try again, or another "
                  "device of geotherm devices"};
    case vk::Result::eErrorIncompatibleDriver:
      return {ErrorCode::kNoDevice, doing +
                                        ": the Vulkan loader found no driver; install one (Debian: "
                                        "mesa-vulkan-drivers, which also draws without a GPU)"};
    default:
      return {ErrorCode::kNoDevice, doing + ": Vulkan answered " + vk::to_string(status) +
                                        "; try another device of geotherm devices"};
  }
}

}  // namespace geotherm::engine
