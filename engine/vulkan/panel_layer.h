// SPDX-License-Identifier: MIT
#pragma once

#include "engine/overlay/panel_draw.h"
#include "engine/vulkan/descriptors.h"
#include "engine/vulkan/device_state.h"
#include "engine/vulkan/pipelines.h"

namespace geotherm::engine {

/// Panels on the device, and the commands that draw them. Nothing may be drawing while it is
/// changed or prepared. Methods throw and then leave what was there.
class PanelLayer {
 public:
  PanelLayer(std::shared_ptr<Device::State> device, vk::DescriptorSetLayout layout);

  void set_font(const PanelFont& font);
  /// What the next frame shows; null: nothing. Without a font nothing is shown.
  void prepare(const PanelDraw* panels);
  bool empty() const { return commands_.empty(); }
  /// Within a rendering to the target; leaves the scissor changed.
  void record(const vk::raii::CommandBuffer& commands, Pipelines& pipelines, glm::ivec2 extent);

 private:
  // Members are destroyed from the last to the first.
  std::shared_ptr<Device::State> device_;
  vk::raii::Sampler sampler_;
  Texture font_;
  std::uint64_t version_ = 0;  ///< of font_, where there is one
  Buffer vertices_, indices_;
  std::vector<PanelDraw::Command> commands_;
  Descriptors descriptors_;
};

}  // namespace geotherm::engine
