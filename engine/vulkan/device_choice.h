// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/device.h"
#include "engine/vulkan/presentation.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// A device with what it is and what it lacks.
struct Candidate {
  vk::raii::PhysicalDevice device;
  DeviceInfo info;
  std::uint32_t queue_family = 0;  ///< one that draws and copies, and presents where that is needed
};

/// What pictures need: Vulkan 1.3, dynamic rendering, synchronization2, a queue that draws, four
/// samples a pixel; with `presentation` a queue that draws and presents as well, and swapchains. In
/// the order of preference: GPUs before software.
std::vector<Candidate> examine_devices(const vk::raii::Instance& instance,
                                       const Presentation* presentation = nullptr);

/// The index of the first that can be used and whose name contains `name` (in any case).
/// Throws Failure that lists all of them with what they lack.
std::size_t choose_device(const std::vector<Candidate>& candidates, const std::string& name);

}  // namespace geotherm::engine
