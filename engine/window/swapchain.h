// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/vulkan/device_state.h"

namespace geotherm::engine {

/// The images that a surface shows in turn. Nothing may be drawing into them when it is replaced or
/// destroyed. Members are destroyed from the last to the first.
struct Swapchain {
  Swapchain() = default;
  /// As large as the surface, or `pixels` where that leaves the size to us; takes over from `old`,
  /// which shows nothing from then on. Empty when the surface has no size now. Throws.
  Swapchain(const Device::State& device, vk::SurfaceKHR surface, vk::SurfaceFormatKHR format,
            glm::ivec2 pixels, const Swapchain& old);

  bool empty() const { return images.empty(); }

  glm::ivec2 extent{0, 0};
  vk::Format format = vk::Format::eUndefined;
  vk::raii::SwapchainKHR swapchain = nullptr;
  std::vector<vk::Image> images;
  std::vector<vk::raii::ImageView> views;  ///< one an image
  std::vector<vk::raii::Semaphore> drawn;  ///< one an image: it may be shown
};

/// A format that keeps the bytes which shaders write: they are sRGB already. Throws where the
/// surface has none.
vk::SurfaceFormatKHR choose_format(const vk::raii::PhysicalDevice& device, vk::SurfaceKHR surface);

}  // namespace geotherm::engine
