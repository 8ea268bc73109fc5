// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "engine/device.h"
#include "engine/vulkan/device_choice.h"
#include "engine/vulkan/instance.h"
#include "engine/vulkan/memory.h"

namespace geotherm::engine {

/// All that a device is made of. Members are destroyed from the last to the first.
struct Device::State {
  State(const DeviceOptions& options, Instance made, Candidate chosen);

  Instance instance;
  vk::raii::PhysicalDevice physical;
  DeviceInfo info;
  std::uint32_t queue_family;
  vk::raii::Device device;
  vk::raii::Queue queue;
  vk::raii::CommandPool pool;
  vk::raii::PipelineCache pipelines;
  MemorySource memory;

  vk::raii::CommandBuffer make_commands() const;
  /// Records, submits and waits. Throws.
  void run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;
  /// A buffer on the device with these bytes in it. Throws.
  Buffer upload(std::span<const std::byte> bytes, vk::BufferUsageFlags usage) const;
  /// Replaces the bytes of a buffer made by upload(); nothing may be drawing from it. Throws.
  void update(const Buffer& buffer, std::span<const std::byte> bytes) const;
};

/// Submits recorded commands and waits for them. Throws.
void submit_and_wait(const Device::State& device, const vk::raii::CommandBuffer& commands);

/// Moves an image from one layout and use to another.
struct Transition {
  vk::Image image;
  vk::ImageLayout from, to;
  vk::PipelineStageFlags2 from_stage;
  vk::AccessFlags2 from_access;
  vk::PipelineStageFlags2 to_stage;
  vk::AccessFlags2 to_access;
  vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor;
};
void record_transition(const vk::raii::CommandBuffer& commands, const Transition& transition);

template <class T>
std::span<const std::byte> bytes_of(const T& range) {
  return std::as_bytes(std::span(range));
}

}  // namespace geotherm::engine
