// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

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

}  // namespace geotherm::engine
