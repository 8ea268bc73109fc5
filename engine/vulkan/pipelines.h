// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <tuple>

#include "engine/vulkan/device_state.h"

namespace geotherm::engine {

/// All pipelines of the renderer and their layout; each is made when it is first needed, those of
/// the surface one for each set of features. Methods throw.
class Pipelines {
 public:
  explicit Pipelines(std::shared_ptr<Device::State> device);

  /// Chooses the format and the sample count of the targets that will be drawn into. Pipelines of
  /// others are kept: pictures that are saved have another format than the window between them.
  void use(vk::Format format, vk::SampleCountFlagBits samples);

  vk::DescriptorSetLayout set_layout() const { return *set_layout_; }
  vk::PipelineLayout layout() const { return *layout_; }

  vk::Pipeline surface(std::uint32_t features);  ///< features: shared.h
  vk::Pipeline arrows();
  vk::Pipeline lines(bool hidden);
  vk::Pipeline markers(bool hidden);
  vk::Pipeline overlay();
  vk::Pipeline panels();

  static constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;
  static constexpr auto kPushStages =
      vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

 private:
  struct Plan;
  vk::Pipeline made(std::uint32_t kind, const Plan& plan);

  std::shared_ptr<Device::State> device_;
  vk::SampleCountFlagBits samples_ = vk::SampleCountFlagBits::e1;
  vk::Format format_ = vk::Format::eUndefined;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  using Key = std::tuple<vk::Format, vk::SampleCountFlagBits, std::uint32_t>;
  std::map<Key, vk::raii::Pipeline> pipelines_;
};

}  // namespace geotherm::engine
