// SPDX-License-Identifier: MIT
#pragma once

#include "engine/target.h"
#include "engine/vulkan/vulkan.h"

namespace geotherm::engine {

/// One frame of a target, between begin() and end(). The image is to be left in the layout
/// eColorAttachmentOptimal, written by eColorAttachmentOutput.
struct TargetFrame {
  const vk::raii::CommandBuffer* commands = nullptr;
  vk::Image image;
  vk::ImageView view;
  vk::Format format = vk::Format::eUndefined;
  glm::ivec2 origin{0, 0};  ///< its first pixel in the whole picture
};

}  // namespace geotherm::engine
