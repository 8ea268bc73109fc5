// SPDX-License-Identifier: MIT
#pragma once

#include "engine/vulkan/device_state.h"

namespace geotherm::engine {

/// Writes bytes that change with every frame, into a larger buffer where they do not fit. Nothing
/// may be drawing from it. Throws.
void write_host(const Device::State& device, Buffer& buffer, std::span<const std::byte> bytes,
                vk::BufferUsageFlags usage);

/// An image of 8-bit coverage, for fragment shaders to sample. Throws.
Texture upload_coverage(const Device::State& device, vk::Extent2D extent,
                        std::span<const std::uint8_t> pixels);

/// Outside of the image its border continues.
vk::raii::Sampler make_sampler(const vk::raii::Device& device, vk::Filter filter);

}  // namespace geotherm::engine
