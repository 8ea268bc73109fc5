// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "engine/device.h"
#include "engine/target.h"
#include "engine/vulkan/instance.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// Counts device memory and refuses what goes beyond the limit.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}

  void take(std::uint64_t bytes);  ///< throws Failure with the figures
  void give_back(std::uint64_t bytes) { used_ -= bytes; }
  std::uint64_t used() const { return used_; }
  std::uint64_t peak() const { return peak_; }

 private:
  std::uint64_t limit_;
  std::atomic<std::uint64_t> used_ = 0, peak_ = 0;
};

/// Where memory comes from.
struct MemorySource {
  const vk::raii::Device* device = nullptr;
  vk::PhysicalDeviceMemoryProperties properties;
  std::shared_ptr<MemoryBudget> budget;
  bool staging = false;  ///< leave device memory unmapped even where the host could see it
};

/// One allocation; gives its bytes back to the budget.
class Memory {
 public:
  Memory() = default;
  /// The first type that has all of `needed` and, if there is one, all of `wished` as well.
  Memory(const MemorySource& source, const vk::MemoryRequirements& requirements,
         vk::MemoryPropertyFlags needed, vk::MemoryPropertyFlags wished);
  Memory(Memory&& other) noexcept;
  Memory& operator=(Memory&& other) noexcept;
  ~Memory();

  vk::DeviceMemory handle() const { return *memory_; }
  bool visible() const { return mapped_ != nullptr; }
  std::byte* mapped() const { return mapped_; }  ///< coherent; null when the host cannot see it

 private:
  void allocate(const MemorySource& source, std::uint64_t bytes, std::uint32_t best,
                std::uint32_t enough, vk::MemoryPropertyFlags needed);

  vk::raii::DeviceMemory memory_ = nullptr;
  std::shared_ptr<MemoryBudget> budget_;
  std::uint64_t bytes_ = 0;
  std::byte* mapped_ = nullptr;
};

enum class Home {
  kDevice,    ///< fast to draw from; written through a staging copy where the host cannot see it
  kHost,      ///< written by the host
  kReadBack,  ///< read by the host
};

struct Buffer {
  Buffer() = default;
  Buffer(const MemorySource& source, vk::DeviceSize bytes, vk::BufferUsageFlags usage, Home home);

  Memory memory;
  vk::raii::Buffer buffer = nullptr;
  vk::DeviceSize bytes = 0;
};

/// A picture of one mip level, its memory and a view of all of it.
struct Texture {
  Texture() = default;
  Texture(const MemorySource& source, vk::Extent2D extent, vk::Format format,
          vk::ImageUsageFlags usage, vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1);

  Memory memory;
  vk::raii::Image image = nullptr;
  vk::raii::ImageView view = nullptr;
  vk::Extent2D extent{};
};

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

/// One frame of a target, between begin() and end(). The image is to be left in the layout
/// eColorAttachmentOptimal, written by eColorAttachmentOutput.
struct TargetFrame {
  const vk::raii::CommandBuffer* commands = nullptr;
  vk::Image image;
  vk::ImageView view;
  vk::Format format = vk::Format::eUndefined;
  glm::ivec2 origin{0, 0};  ///< its first pixel in the whole picture
  bool copyable = false;    ///< another image may be copied to it
};

template <class T>
std::span<const std::byte> bytes_of(const T& range) {
  return std::as_bytes(std::span(range));
}

/// Writes bytes that change with every frame, into a larger buffer where they do not fit. Nothing
/// may be drawing from it. Throws.
void write_host(const Device::State& device, Buffer& buffer, std::span<const std::byte> bytes,
                vk::BufferUsageFlags usage);

/// An image of 8-bit coverage, for fragment shaders to sample. Throws.
Texture upload_coverage(const Device::State& device, vk::Extent2D extent,
                        std::span<const std::uint8_t> pixels);

/// Outside of the image its border continues.
vk::raii::Sampler make_sampler(const vk::raii::Device& device, vk::Filter filter);

/// One descriptor set of the layout that all pipelines share, and the pool it is from. Members are
/// destroyed from the last to the first.
struct Descriptors {
  Descriptors(const vk::raii::Device& device, vk::DescriptorSetLayout layout);

  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet set;
};

}  // namespace geotherm::engine
