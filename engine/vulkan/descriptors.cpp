// SPDX-License-Identifier: MIT
#include "engine/vulkan/descriptors.h"

#include <array>

namespace geotherm::engine {
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
