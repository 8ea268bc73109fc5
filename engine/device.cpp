// SPDX-License-Identifier: MIT
#include "engine/device.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "engine/vulkan/device_state.h"
#include "engine/vulkan/vulkan.h"
#include "engine/window/window_state.h"

namespace geotherm::engine {
namespace {

/// Null: nothing is to be shown in a window.
const Presentation* presentation_of(const DeviceOptions& options) {
  return options.window != nullptr ? &options.window->state() : nullptr;
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family,
                             bool presents) {
  constexpr float kPriority = 1.0F;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &kPriority);
  vk::PhysicalDeviceVulkan13Features features;
  features.setDynamicRendering(VK_TRUE).setSynchronization2(VK_TRUE);
  vk::DeviceCreateInfo info({}, queue);
  info.setPNext(&features);
  constexpr const char* kSwapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  if (presents) info.setPEnabledExtensionNames(kSwapchain);
  return {physical, info};
}

vk::raii::CommandPool make_pool(const vk::raii::Device& device, std::uint32_t family) {
  return {device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, family}};
}

}  // namespace

Device::State::State(const DeviceOptions& options, Instance made, Candidate chosen)
    : instance(std::move(made)),
      physical(std::move(chosen.device)),
      info(std::move(chosen.info)),
      queue_family(chosen.queue_family),
      device(make_device(physical, queue_family, options.window != nullptr)),
      queue(device, queue_family, 0),
      pool(make_pool(device, queue_family)),
      pipelines(device, vk::PipelineCacheCreateInfo()),
      memory{&device, physical.getMemoryProperties(),
             std::make_shared<MemoryBudget>(options.memory_limit), options.staging} {}

vk::raii::CommandBuffer Device::State::make_commands() const {
  vk::raii::CommandBuffers made(device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
  return std::move(made.front());
}

void Device::State::run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const {
  const vk::raii::CommandBuffer commands = make_commands();
  commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record(commands);
  commands.end();
  submit_and_wait(*this, commands);
}

Buffer Device::State::upload(std::span<const std::byte> bytes, vk::BufferUsageFlags usage) const {
  const vk::DeviceSize size = std::max<vk::DeviceSize>(bytes.size(), 4);  // none may be empty
  Buffer buffer(memory, size, usage | vk::BufferUsageFlagBits::eTransferDst, Home::kDevice);
  update(buffer, bytes);
  return buffer;
}

void Device::State::update(const Buffer& buffer, std::span<const std::byte> bytes) const {
  if (bytes.empty()) return;
  if (bytes.size() > buffer.bytes) {
    throw Failure({ErrorCode::kBadInput, "a buffer of " + std::to_string(buffer.bytes) +
                                             " bytes has no room for " +
                                             std::to_string(bytes.size())});
  }
  if (buffer.memory.visible()) {
    std::memcpy(buffer.memory.mapped(), bytes.data(), bytes.size());
    return;
  }
  const Buffer staging(memory, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, Home::kHost);
  std::memcpy(staging.memory.mapped(), bytes.data(), bytes.size());
  run([&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*staging.buffer, *buffer.buffer, vk::BufferCopy(0, 0, bytes.size()));
    // Later submissions read it as whatever it is.
    const vk::MemoryBarrier2 barrier(
        vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferWrite,
        vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, barrier));
  });
}

void submit_and_wait(const Device::State& device, const vk::raii::CommandBuffer& commands) {
  const vk::raii::Fence done(device.device, vk::FenceCreateInfo());
  const vk::CommandBufferSubmitInfo buffer(*commands);
  device.queue.submit2(vk::SubmitInfo2({}, {}, buffer), *done);
  check(device.device.waitForFences(*done, VK_TRUE, UINT64_MAX), "waiting for the device");
}

void record_transition(const vk::raii::CommandBuffer& commands, const Transition& t) {
  const vk::ImageMemoryBarrier2 barrier(t.from_stage, t.from_access, t.to_stage, t.to_access,
                                        t.from, t.to, VK_QUEUE_FAMILY_IGNORED,
                                        VK_QUEUE_FAMILY_IGNORED, t.image, {t.aspect, 0, 1, 0, 1});
  commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

Result<std::vector<DeviceInfo>> list_devices() {
  return guarded("listing devices", []() -> Result<std::vector<DeviceInfo>> {
    const Instance instance(false);
    std::vector<DeviceInfo> devices;
    for (const Candidate& candidate : examine_devices(instance.instance)) {
      devices.push_back(candidate.info);
    }
    return devices;
  });
}

Result<Device> Device::open(const DeviceOptions& options) {
  return guarded("opening the device", [&]() -> Result<Device> {
    const Presentation* const presentation = presentation_of(options);
    Instance instance(options.validation, presentation);
    std::vector<Candidate> candidates = examine_devices(instance.instance, presentation);
    const std::size_t chosen = choose_device(candidates, options.name);
    return Device(
        std::make_shared<State>(options, std::move(instance), std::move(candidates[chosen])));
  });
}

const DeviceInfo& Device::info() const { return state_->info; }

std::vector<std::string> Device::validation_messages() const {
  return state_->instance.log->messages();
}

std::uint64_t Device::memory_used() const { return state_->memory.budget->used(); }
std::uint64_t Device::peak_memory() const { return state_->memory.budget->peak(); }

int Device::largest_picture() const {
  const vk::PhysicalDeviceLimits limits = state_->physical.getProperties().limits;
  return static_cast<int>(
      std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]}));
}

}  // namespace geotherm::engine
