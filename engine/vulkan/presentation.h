// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// What the window system knows of Vulkan. Implemented by windows; all that opens a device or shows
/// pictures knows windows only as this.
class Presentation {
 public:
  /// Instance extensions without which there are no surfaces; valid as long as the window.
  virtual std::vector<const char*> instance_extensions() const = 0;
  virtual bool can_present(vk::Instance instance, vk::PhysicalDevice device,
                           std::uint32_t queue_family) const = 0;
  /// The window's surface; the caller owns it. Throws.
  virtual vk::SurfaceKHR make_surface(vk::Instance instance) const = 0;

 protected:
  ~Presentation() = default;
};

}  // namespace geotherm::engine
