// SPDX-License-Identifier: MIT
#include "engine/window/window_target.h"

#include <cassert>
#include <optional>
#include <utility>

#include "engine/vulkan/device_state.h"
#include "engine/vulkan/target_frame.h"
#include "engine/vulkan/vulkan_error.h"
#include "engine/window/swapchain.h"
#include "engine/window/window_state.h"

namespace geotherm::engine {
namespace {

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
    throw Failure({ErrorCode::kNoDevice, "the device '" + device->info.name +
                                             "' cannot show pictures in this window; try another "
                                             "device of geotherm devices"});
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
                     "drawing in the window: its surface was lost twice; start again, or draw "
                     "with geotherm render"});
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
  frame = {&commands, picture, *swapchain.views[*image], swapchain.format, -corner};
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
  return guarded(kDoing, [&]() -> Result<void> {
    state_->begin(frame);
    return {};
  });
}

Result<void> WindowTarget::end(TargetFrame& /*frame*/) {
  return guarded(kDoing, [&]() -> Result<void> {
    state_->end();
    return {};
  });
}

}  // namespace geotherm::engine
