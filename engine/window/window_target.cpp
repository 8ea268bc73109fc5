// SPDX-License-Identifier: MIT
#include "engine/window/window_target.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "engine/vulkan/device_state.h"
#include "engine/vulkan/vulkan.h"
#include "engine/window/window_state.h"

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
  bool copyable = false;  ///< the surface takes copies of images
  vk::raii::SwapchainKHR swapchain = nullptr;
  std::vector<vk::Image> images;
  std::vector<vk::raii::ImageView> views;  ///< one an image
  std::vector<vk::raii::Semaphore> drawn;  ///< one an image: it may be shown
};

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
  vk::ImageUsageFlags usage = vk::ImageUsageFlagBits::eColorAttachment;
  copyable = static_cast<bool>(can.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst);
  if (copyable) usage |= vk::ImageUsageFlagBits::eTransferDst;
  vk::SwapchainCreateInfoKHR info;
  info.setSurface(surface)
      .setMinImageCount(image_count(can))
      .setImageFormat(surface_format.format)
      .setImageColorSpace(surface_format.colorSpace)
      .setImageExtent(size)
      .setImageArrayLayers(1)
      .setImageUsage(usage)
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

namespace {

/// A format that keeps the bytes which shaders write: they are sRGB already. Throws where the
/// surface has none.
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
                 "the window takes no plain 8-bit colours from this device",
                 {"try another device"}});
}

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;
constexpr const char* kDoing = "drawing in the window";

/// A surface may become outdated as often as a window is resized while we look.
constexpr int kMaxAttempts = 8;

}  // namespace

/// Members are destroyed from the last to the first.
struct WindowTarget::State {
  State(std::shared_ptr<Device::State> on, Window& to);
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  bool follow();
  bool take_image(glm::ivec2 pixels);
  void make_swapchain(glm::ivec2 pixels);
  void make_surface();
  void give_up_image();
  bool acquire();
  void begin(TargetFrame& frame);
  void end();
  void present();

  std::shared_ptr<Device::State> device;
  Window& window;
  vk::raii::SurfaceKHR surface = nullptr;
  vk::SurfaceFormatKHR format;
  Swapchain swapchain;
  glm::ivec2 made_for{0, 0};           ///< the window's pixels when the swapchain was made
  bool stale = true;                   ///< the swapchain does not suit the surface any more
  bool lost = false;                   ///< nor does the surface suit the window
  bool renewed = false;                ///< it was replaced, and has shown nothing since
  std::optional<std::uint32_t> image;  ///< ours to draw into
  glm::ivec2 corner{0, 0};
  vk::raii::Semaphore acquired;  ///< signalled or about to be while there is an image
  vk::raii::Fence done;
  vk::raii::CommandBuffer commands;
};

WindowTarget::State::State(std::shared_ptr<Device::State> on, Window& to)
    : device(std::move(on)),
      window(to),
      acquired(device->device, vk::SemaphoreCreateInfo()),
      done(device->device, vk::FenceCreateInfo()),
      commands(device->make_commands()) {
  make_surface();
  renewed = false;
}

WindowTarget::State::~State() {
  try {
    give_up_image();
    device->device.waitIdle();
  } catch (const vk::SystemError&) {
    // A lost device draws nothing any more either.
  }
}

void WindowTarget::State::make_surface() {
  renewed = true;
  give_up_image();
  device->device.waitIdle();
  std::exchange(swapchain, {});
  surface = nullptr;  // first: a window has one at most
  surface = vk::raii::SurfaceKHR(device->instance.instance,
                                 window.state().make_surface(*device->instance.instance));
  if (device->physical.getSurfaceSupportKHR(device->queue_family, *surface) == VK_FALSE) {
    throw Failure({ErrorCode::kNoDevice,
                   "the device '" + device->info.name + "' cannot show pictures in this window",
                   {"try another device"}});
  }
  format = choose_format(device->physical, *surface);
  stale = true;
  lost = false;
}

/// An image that was taken and not shown leaves a signal behind, which is waited for here.
void WindowTarget::State::give_up_image() {
  if (!image) return;
  image.reset();
  stale = true;  // only that brings the image back
  const vk::SemaphoreSubmitInfo wait(*acquired, 0, Stage::eAllCommands);
  device->device.resetFences(*done);
  device->queue.submit2(vk::SubmitInfo2({}, wait), *done);
  check(device->device.waitForFences(*done, VK_TRUE, UINT64_MAX), kDoing);
}

void WindowTarget::State::make_swapchain(glm::ivec2 pixels) {
  give_up_image();
  device->device.waitIdle();  // presenting has no fence
  stale = true;
  const Swapchain old = std::exchange(swapchain, {});  // retired, whatever becomes of the new one
  swapchain = Swapchain(*device, *surface, format, pixels, old);
  made_for = pixels;
  stale = false;
}

/// False: the swapchain is stale.
bool WindowTarget::State::acquire() {
  std::uint32_t index = 0;
  const auto status = static_cast<vk::Result>(device->device.getDispatcher()->vkAcquireNextImageKHR(
      *device->device, *swapchain.swapchain, UINT64_MAX, *acquired, VK_NULL_HANDLE, &index));
  if (status == vk::Result::eErrorOutOfDateKHR) {
    stale = true;
    return false;
  }
  if (status == vk::Result::eSuboptimalKHR) {
    stale = true;  // good enough for this frame
  } else {
    check(status, kDoing);
  }
  image = index;
  return true;
}

bool WindowTarget::State::take_image(glm::ivec2 pixels) {
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    if (stale || made_for != pixels) make_swapchain(pixels);
    if (swapchain.empty()) {
      stale = true;
      return false;
    }
    if (image || acquire()) return true;
    pixels = window.pixels();
    if (pixels.x <= 0 || pixels.y <= 0) return false;
  }
  return false;
}

bool WindowTarget::State::follow() {
  const glm::ivec2 pixels = window.pixels();
  if (pixels.x <= 0 || pixels.y <= 0) return false;
  while (true) {
    try {
      if (lost) make_surface();
      return take_image(pixels);
    } catch (const vk::SurfaceLostKHRError&) {
      lost = true;
    }
    if (renewed) {
      throw Failure({ErrorCode::kNoDevice,
                     "drawing in the window: its surface was lost twice",
                     {"start again, or draw into a file"}});
    }
  }
}

void WindowTarget::State::begin(TargetFrame& frame) {
  if (!image && !follow()) {
    throw Failure({ErrorCode::kNoDevice, "drawing in the window: it has no size now"});
  }
  commands.reset();
  commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  const vk::Image picture = swapchain.images[*image];
  // After the semaphore, for which this stage waits.
  record_transition(commands,
                    {picture, Layout::eUndefined, Layout::eColorAttachmentOptimal,
                     Stage::eColorAttachmentOutput, Access::eNone, Stage::eColorAttachmentOutput,
                     Access::eColorAttachmentWrite | Access::eColorAttachmentRead});
  frame = {&commands,        picture, *swapchain.views[*image],
           swapchain.format, -corner, swapchain.copyable};
}

void WindowTarget::State::end() {
  const std::uint32_t index = *image;
  record_transition(
      commands, {swapchain.images[index], Layout::eColorAttachmentOptimal, Layout::ePresentSrcKHR,
                 Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                 Stage::eColorAttachmentOutput, Access::eNone});
  commands.end();
  const vk::SemaphoreSubmitInfo wait(*acquired, 0, Stage::eColorAttachmentOutput);
  const vk::SemaphoreSubmitInfo signal(*swapchain.drawn[index], 0, Stage::eAllCommands);
  const vk::CommandBufferSubmitInfo buffer(*commands);
  device->device.resetFences(*done);
  device->queue.submit2(vk::SubmitInfo2({}, wait, buffer, signal), *done);
  present();
  check(device->device.waitForFences(*done, VK_TRUE, UINT64_MAX), kDoing);
}

/// What a surface has become is no error of this frame: the next one follows.
void WindowTarget::State::present() {
  const std::uint32_t index = *image;
  image.reset();
  const vk::PresentInfoKHR info(*swapchain.drawn[index], *swapchain.swapchain, index);
  const auto status = static_cast<vk::Result>(device->device.getDispatcher()->vkQueuePresentKHR(
      *device->queue, reinterpret_cast<const VkPresentInfoKHR*>(&info)));
  switch (status) {
    case vk::Result::eSuboptimalKHR:
    case vk::Result::eErrorOutOfDateKHR:
      stale = true;
      break;
    case vk::Result::eErrorSurfaceLostKHR:
      lost = true;
      return;
    default:
      check(status, kDoing);
  }
  renewed = false;
}

WindowTarget::WindowTarget(std::unique_ptr<State> state) : state_(std::move(state)) {}
WindowTarget::~WindowTarget() = default;

Result<std::unique_ptr<WindowTarget>> WindowTarget::build(const Device& device, Window& window) {
  return guarded(kDoing, [&]() -> Result<std::unique_ptr<WindowTarget>> {
    return std::unique_ptr<WindowTarget>(
        new WindowTarget(std::make_unique<State>(device.state(), window)));
  });
}

Result<bool> WindowTarget::follow_window() {
  return guarded(kDoing, [&]() -> Result<bool> { return state_->follow(); });
}

void WindowTarget::set_picture_corner(glm::ivec2 corner) { state_->corner = corner; }

glm::ivec2 WindowTarget::extent() const { return state_->swapchain.extent; }

Result<void> WindowTarget::begin(TargetFrame& frame) {
  return guarded(kDoing, [&] { state_->begin(frame); });
}

Result<void> WindowTarget::end(TargetFrame& /*frame*/) {
  return guarded(kDoing, [&] { state_->end(); });
}

}  // namespace geotherm::engine
