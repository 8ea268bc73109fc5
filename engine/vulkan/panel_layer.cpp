// SPDX-License-Identifier: MIT
#include "engine/vulkan/panel_layer.h"

#include <cassert>

#include "engine/vulkan/upload.h"
#include "shaders/shared.h"

namespace geotherm::engine {
namespace {

/// The pixels of the target whose centres lie in the rectangle.
vk::Rect2D scissor_of(const glm::vec4& clip, glm::vec2 extent) {
  const glm::vec2 min = glm::clamp(glm::ceil(glm::vec2(clip.x, clip.y) - 0.5F), {0, 0}, extent);
  const glm::vec2 max = glm::clamp(glm::ceil(glm::vec2(clip.z, clip.w) - 0.5F), min, extent);
  const glm::ivec2 offset(min);
  const glm::uvec2 size(max - min);
  return {{offset.x, offset.y}, {size.x, size.y}};
}

}  // namespace

PanelLayer::PanelLayer(std::shared_ptr<Device::State> device, vk::DescriptorSetLayout layout)
    : device_(std::move(device)),
      // Thin lines are drawn as quads over a ramp in the image, between whole pixels.
      sampler_(make_sampler(device_->device, vk::Filter::eLinear)),
      descriptors_(device_->device, layout) {}

void PanelLayer::set_font(const PanelFont& font) {
  if (*font_.image && font.version == version_) return;
  font_ = upload_coverage(
      *device_, {static_cast<std::uint32_t>(font.width), static_cast<std::uint32_t>(font.height)},
      font.pixels);
  version_ = font.version;
  const vk::DescriptorImageInfo image(*sampler_, *font_.view,
                                      vk::ImageLayout::eShaderReadOnlyOptimal);
  const vk::WriteDescriptorSet write(*descriptors_.set, shared::kAtlasBinding, 0,
                                     vk::DescriptorType::eCombinedImageSampler, image);
  device_->device.updateDescriptorSets(write, {});
}

void PanelLayer::prepare(const PanelDraw* panels) {
  commands_.clear();
  // Without letters nothing can be drawn: an image that is not there ends the program in some
  // drivers.
  if (panels == nullptr || panels->commands.empty() || !*font_.image) return;
  write_host(*device_, vertices_, bytes_of(panels->vertices),
             vk::BufferUsageFlagBits::eVertexBuffer);
  write_host(*device_, indices_, bytes_of(panels->indices), vk::BufferUsageFlagBits::eIndexBuffer);
  for (const PanelDraw::Command& command : panels->commands) {
    assert(command.first_index + command.index_count <= panels->indices.size());
    if (command.index_count > 0) commands_.push_back(command);
  }
}

void PanelLayer::record(const vk::raii::CommandBuffer& commands, Pipelines& pipelines,
                        glm::ivec2 extent) {
  if (empty()) return;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines.panels());
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines.layout(), 0,
                              *descriptors_.set, {});
  commands.bindVertexBuffers(0, *vertices_.buffer, {0});
  commands.bindIndexBuffer(*indices_.buffer, 0, vk::IndexType::eUint16);
  commands.pushConstants<shared::PanelPush>(pipelines.layout(), Pipelines::kPushStages, 0,
                                            shared::PanelPush{2.0F / glm::vec2(extent)});
  for (const PanelDraw::Command& command : commands_) {
    const vk::Rect2D scissor = scissor_of(command.clip, extent);
    if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
    commands.setScissor(0, scissor);
    commands.drawIndexed(command.index_count, 1, command.first_index, command.vertex_offset, 0);
  }
}

}  // namespace geotherm::engine
