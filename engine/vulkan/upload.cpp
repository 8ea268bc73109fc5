// SPDX-License-Identifier: MIT
#include "engine/vulkan/upload.h"

#include <cassert>
#include <cstring>

namespace geotherm::engine {
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

}  // namespace geotherm::engine
