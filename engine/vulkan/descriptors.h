// SPDX-License-Identifier: MIT
#pragma once

#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// One descriptor set of the layout that all pipelines share, and the pool it is from. Members are
/// destroyed from the last to the first.
struct Descriptors {
  Descriptors(const vk::raii::Device& device, vk::DescriptorSetLayout layout);

  vk::raii::DescriptorPool pool;
  vk::raii::DescriptorSet set;
};

}  // namespace geotherm::engine
