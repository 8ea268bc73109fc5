// SPDX-License-Identifier: MIT
#include "engine/window/swapchain.h"

#include <algorithm>
#include <array>

#include "engine/vulkan/vulkan_error.h"

namespace geotherm::engine {
namespace {

/// What the surface is now, or where it takes any size, what the window wants.
vk::Extent2D extent_of(const vk::SurfaceCapabilitiesKHR& can, glm::ivec2 pixels) {
  constexpr std::uint32_t kAny = 0xFFFFFFFF;
  if (can.currentExtent.width != kAny) return can.currentExtent;
  const glm::uvec2 wish(glm::max(pixels, glm::ivec2(0)));
  return {std::clamp(wish.x, can.minImageExtent.width, can.maxImageExtent.width),
          std::clamp(wish.y, can.minImageExtent.height, can.maxImageExtent.height)};
}

/// One more than the system needs, so that the next can be drawn while one waits to be shown.
std::uint32_t image_count(const vk::SurfaceCapabilitiesKHR& can) {
  const std::uint32_t wish = can.minImageCount + 1;
  return can.maxImageCount == 0 ? wish : std::min(wish, can.maxImageCount);
}

/// Opaque: a picture's transparent background is not the desktop's.
vk::CompositeAlphaFlagBitsKHR composite_alpha(const vk::SurfaceCapabilitiesKHR& can) {
  using Alpha = vk::CompositeAlphaFlagBitsKHR;
  for (const Alpha wish : {Alpha::eOpaque, Alpha::eInherit, Alpha::ePreMultiplied}) {
    if (can.supportedCompositeAlpha & wish) return wish;
  }
  return Alpha::ePostMultiplied;
}

}  // namespace

Swapchain::Swapchain(const Device::State& device, vk::SurfaceKHR surface,
                     vk::SurfaceFormatKHR surface_format, glm::ivec2 pixels, const Swapchain& old) {
  const auto can = device.physical.getSurfaceCapabilitiesKHR(surface);
  const vk::Extent2D size = extent_of(can, pixels);
  if (size.width == 0 || size.height == 0) return;
  vk::SwapchainCreateInfoKHR info;
  info.setSurface(surface)
      .setMinImageCount(image_count(can))
      .setImageFormat(surface_format.format)
      .setImageColorSpace(surface_format.colorSpace)
      .setImageExtent(size)
      .setImageArrayLayers(1)
      .setImageUsage(vk::ImageUsageFlagBits::eColorAttachment)
      .setPreTransform(can.currentTransform)
      .setCompositeAlpha(composite_alpha(can))
      .setPresentMode(vk::PresentModeKHR::eFifo)
      .setClipped(VK_TRUE)
      .setOldSwapchain(*old.swapchain);
  swapchain = vk::raii::SwapchainKHR(device.device, info);
  extent = {static_cast<int>(size.width), static_cast<int>(size.height)};
  format = surface_format.format;
  for (const VkImage image : swapchain.getImages()) images.emplace_back(image);
  for (const vk::Image image : images) {
    const vk::ImageViewCreateInfo view({}, image, vk::ImageViewType::e2D, format, {},
                                       {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    views.emplace_back(device.device, view);
    drawn.emplace_back(device.device, vk::SemaphoreCreateInfo());
  }
}

vk::SurfaceFormatKHR choose_format(const vk::raii::PhysicalDevice& device, vk::SurfaceKHR surface) {
  constexpr std::array kWishes = {vk::Format::eB8G8R8A8Unorm, vk::Format::eR8G8B8A8Unorm,
                                  vk::Format::eA8B8G8R8UnormPack32,
                                  vk::Format::eA2B10G10R10UnormPack32};
  const auto offered = device.getSurfaceFormatsKHR(surface);
  for (const vk::Format wish : kWishes) {
    for (const vk::SurfaceFormatKHR& offer : offered) {
      if (offer.format == wish && offer.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear) {
        return offer;
      }
    }
  }
  throw Failure({ErrorCode::kNoDevice,
                 "the window takes no plain 8-bit colours from this device; try another device of "
                 "geotherm devices"});
}

}  // namespace geotherm::engine
