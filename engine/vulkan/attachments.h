// SPDX-License-Identifier: MIT
#pragma once

#include "engine/vulkan/device_state.h"

namespace geotherm::engine {

/// What a scene is drawn into before it reaches the target: depth, and with several samples a pixel
/// their colours. Kept from frame to frame while size and format stay.
struct Attachments {
  Attachments() = default;
  Attachments(const Device::State& device, vk::Extent2D extent, vk::Format format,
              vk::SampleCountFlagBits samples);

  bool fit(vk::Extent2D size, vk::Format colour_format) const {
    return extent == size && format == colour_format;
  }

  vk::Extent2D extent{};
  vk::Format format = vk::Format::eUndefined;
  Texture depth;
  Texture colour;  ///< empty with one sample a pixel
};

/// Begins drawing a scene onto `background` (colours multiplied by alpha), resolving into `target`
/// where there are several samples.
void record_scene_begin(const vk::raii::CommandBuffer& commands, const Attachments& attachments,
                        vk::ImageView target, const vk::ClearColorValue& background);

/// Begins drawing on top of what the target shows.
void record_overlay_begin(const vk::raii::CommandBuffer& commands, vk::Extent2D extent,
                          vk::Image image, vk::ImageView target);

}  // namespace geotherm::engine
