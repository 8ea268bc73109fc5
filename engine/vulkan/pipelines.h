// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "engine/vulkan/device_state.h"

namespace geotherm::engine {

/// All pipelines of the renderer and their layout; those of the surface are made when they are
/// first needed, one for each set of features. Methods throw.
class Pipelines {
 public:
  Pipelines(std::shared_ptr<Device::State> device, vk::SampleCountFlagBits samples);

  /// Of the targets that will be drawn into; another one than before forgets all pipelines.
  void use_format(vk::Format format);

  vk::DescriptorSetLayout set_layout() const { return *set_layout_; }
  vk::PipelineLayout layout() const { return *layout_; }

  vk::Pipeline surface(std::uint32_t features);  ///< features: shared.h
  vk::Pipeline arrows();
  vk::Pipeline visible_markers();
  vk::Pipeline hidden_markers();
  vk::Pipeline overlay();

  static constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;

 private:
  struct Plan;
  vk::Pipeline made(std::uint32_t key, const Plan& plan);

  std::shared_ptr<Device::State> device_;
  vk::SampleCountFlagBits samples_;
  vk::Format format_ = vk::Format::eUndefined;
  vk::raii::Sampler sampler_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  std::map<std::uint32_t, vk::raii::Pipeline> pipelines_;
};

}  // namespace geotherm::engine
