// SPDX-License-Identifier: MIT
#include "engine/vulkan/device_state.h"

#include <array>
#include <cassert>
#include <cstring>
#include <string>
#include <utility>

#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {
namespace {

using Flag = vk::MemoryPropertyFlagBits;
constexpr vk::MemoryPropertyFlags kShared = Flag::eHostVisible | Flag::eHostCoherent;

std::uint32_t memory_type(const vk::PhysicalDeviceMemoryProperties& properties, std::uint32_t bits,
                          vk::MemoryPropertyFlags flags) {
  for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    const bool fits = (bits >> i & 1U) != 0;
    if (fits && (properties.memoryTypes[i].propertyFlags & flags) == flags) return i;
  }
  return VK_MAX_MEMORY_TYPES;
}

std::string megabytes(std::uint64_t bytes) {
  return std::to_string((bytes + (1U << 20U) - 1) >> 20U) + " MB";
}

vk::raii::Buffer make_buffer(const MemorySource& source, vk::DeviceSize bytes,
                             vk::BufferUsageFlags usage) {
  return {*source.device, {{}, bytes, usage, vk::SharingMode::eExclusive}};
}

vk::MemoryPropertyFlags needed_for(Home home) {
  if (home == Home::kDevice) return Flag::eDeviceLocal;
  return kShared;
}

vk::MemoryPropertyFlags wished_for(Home home) {
  if (home == Home::kDevice) return kShared;
  if (home == Home::kReadBack) return Flag::eHostCached;
  return {};
}

vk::ImageAspectFlags aspect_of(vk::Format format) {
  return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth
                                          : vk::ImageAspectFlagBits::eColor;
}

}  // namespace

void MemoryBudget::take(std::uint64_t bytes) {
  const std::uint64_t used = used_ += bytes;
  if (limit_ > 0 && used > limit_) {
    used_ -= bytes;
    throw Failure({ErrorCode::kOutOfMemory,
                   "the device's memory: " + megabytes(bytes) + " more than the " +
                       megabytes(used - bytes) + " in use exceed the limit of " + megabytes(limit_),
                   less_memory()});
  }
  std::uint64_t peak = peak_;
  while (used > peak && !peak_.compare_exchange_weak(peak, used)) {
  }
}

Memory::Memory(const MemorySource& source, const vk::MemoryRequirements& requirements,
               vk::MemoryPropertyFlags needed, vk::MemoryPropertyFlags wished) {
  const std::uint32_t best =
      memory_type(source.properties, requirements.memoryTypeBits, needed | wished);
  const std::uint32_t enough = memory_type(source.properties, requirements.memoryTypeBits, needed);
  if (enough == VK_MAX_MEMORY_TYPES) {
    throw Failure(
        {ErrorCode::kNoDevice,
         "the device has no memory of the kind that is needed (" + vk::to_string(needed) + ")",
         {"try another device"}});
  }
  source.budget->take(requirements.size);
  try {
    allocate(source, requirements.size, best == VK_MAX_MEMORY_TYPES ? enough : best, enough,
             needed);
  } catch (...) {
    source.budget->give_back(requirements.size);  // no destructor runs for what was not made
    throw;
  }
  budget_ = source.budget;
  bytes_ = requirements.size;
}

void Memory::allocate(const MemorySource& source, std::uint64_t bytes, std::uint32_t best,
                      std::uint32_t enough, vk::MemoryPropertyFlags needed) {
  std::uint32_t type = best;
  try {
    memory_ = vk::raii::DeviceMemory(*source.device, {bytes, type});
  } catch (const vk::OutOfDeviceMemoryError&) {
    // What both sides see can be a small part of a GPU's memory.
    if (best == enough) throw;
    type = enough;
    memory_ = vk::raii::DeviceMemory(*source.device, {bytes, type});
  }
  const vk::MemoryPropertyFlags flags = source.properties.memoryTypes[type].propertyFlags;
  const bool wanted = static_cast<bool>(needed & Flag::eHostVisible) || !source.staging;
  if (wanted && (flags & kShared) == kShared) {
    mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
  }
}

Memory::Memory(Memory&& other) noexcept { *this = std::move(other); }

Memory& Memory::operator=(Memory&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(budget_, other.budget_);
  std::swap(bytes_, other.bytes_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

Memory::~Memory() {
  if (budget_) budget_->give_back(bytes_);
}

Buffer::Buffer(const MemorySource& source, vk::DeviceSize size, vk::BufferUsageFlags usage,
               Home home)
    : buffer(make_buffer(source, size, usage)), bytes(size) {
  memory = Memory(source, buffer.getMemoryRequirements(), needed_for(home), wished_for(home));
  buffer.bindMemory(memory.handle(), 0);
}

Texture::Texture(const MemorySource& source, vk::Extent2D size, vk::Format format,
                 vk::ImageUsageFlags usage, vk::SampleCountFlagBits samples)
    : extent(size) {
  image = vk::raii::Image(*source.device, {{},
                                           vk::ImageType::e2D,
                                           format,
                                           {size.width, size.height, 1},
                                           1,
                                           1,
                                           samples,
                                           vk::ImageTiling::eOptimal,
                                           usage,
                                           vk::SharingMode::eExclusive,
                                           {},
                                           vk::ImageLayout::eUndefined});
  memory = Memory(source, image.getMemoryRequirements(), Flag::eDeviceLocal, {});
  image.bindMemory(memory.handle(), 0);
  view = vk::raii::ImageView(
      *source.device,
      {{}, *image, vk::ImageViewType::e2D, format, {}, {aspect_of(format), 0, 1, 0, 1}});
}

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

}  // namespace

void write_host(const Device::State& device, Buffer& buffer, std::span<const std::byte> bytes,
                vk::BufferUsageFlags usage) {
  if (bytes.empty()) return;
  if (buffer.bytes < bytes.size()) {
    buffer = Buffer(device.memory, bytes.size() + bytes.size() / 2, usage, Home::kHost);
  }
  std::memcpy(buffer.memory.mapped(), bytes.data(), bytes.size());
}

Texture upload_coverage(const Device::State& device, vk::Extent2D extent,
                        std::span<const std::uint8_t> pixels) {
  assert(pixels.size() == std::size_t{extent.width} * extent.height);
  Texture texture(device.memory, extent, vk::Format::eR8Unorm,
                  vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  const Buffer staging = device.upload(bytes_of(pixels), vk::BufferUsageFlagBits::eTransferSrc);
  device.run([&](const vk::raii::CommandBuffer& commands) {
    record_transition(commands, {*texture.image, vk::ImageLayout::eUndefined,
                                 vk::ImageLayout::eTransferDstOptimal, Stage::eNone, Access::eNone,
                                 Stage::eCopy, Access::eTransferWrite});
    const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                     {extent.width, extent.height, 1});
    commands.copyBufferToImage(*staging.buffer, *texture.image,
                               vk::ImageLayout::eTransferDstOptimal, region);
    record_transition(
        commands, {*texture.image, vk::ImageLayout::eTransferDstOptimal,
                   vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eCopy, Access::eTransferWrite,
                   Stage::eFragmentShader, Access::eShaderSampledRead});
  });
  return texture;
}

vk::raii::Sampler make_sampler(const vk::raii::Device& device, vk::Filter filter) {
  vk::SamplerCreateInfo info({}, filter, filter);
  info.setAddressModeU(vk::SamplerAddressMode::eClampToEdge)
      .setAddressModeV(vk::SamplerAddressMode::eClampToEdge);
  return {device, info};
}

namespace {

vk::raii::DescriptorPool make_pool(const vk::raii::Device& device) {
  const std::array sizes = {vk::DescriptorPoolSize(vk::DescriptorType::eUniformBuffer, 1),
                            vk::DescriptorPoolSize(vk::DescriptorType::eUniformTexelBuffer, 1),
                            vk::DescriptorPoolSize(vk::DescriptorType::eCombinedImageSampler, 1)};
  return {device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes}};
}

vk::raii::DescriptorSet make_set(const vk::raii::Device& device, const vk::DescriptorPool& pool,
                                 const vk::DescriptorSetLayout& layout) {
  vk::raii::DescriptorSets sets(device, {pool, layout});
  return std::move(sets.front());
}

}  // namespace

Descriptors::Descriptors(const vk::raii::Device& device, vk::DescriptorSetLayout layout)
    : pool(make_pool(device)), set(make_set(device, *pool, layout)) {}

}  // namespace geotherm::engine
