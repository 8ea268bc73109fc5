// SPDX-License-Identifier: MIT
#include "engine/vulkan/frame_recorder.h"

#include <array>
#include <cassert>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "engine/vulkan/frame_uniforms.h"
#include "shaders/shared.h"

namespace geotherm::engine {
namespace {

using Usage = vk::BufferUsageFlagBits;
constexpr auto kBothStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
constexpr float kHiddenOpacity = 0.33F;  // of the rim; what lies on it adds as much
/// Arrows towards the eye, in their full lengths; the second field lies on the first.
constexpr float kLift = 0.35F;
constexpr float kLiftOfSecond = 0.42F;

/// Writes bytes that change with every frame, into a larger buffer where they do not fit.
void write_host(const Device::State& device, Buffer& buffer, std::span<const std::byte> bytes,
                vk::BufferUsageFlags usage) {
  if (bytes.empty()) return;
  if (buffer.bytes < bytes.size()) {
    buffer = Buffer(device.memory, bytes.size() + bytes.size() / 2, usage, Home::kHost);
  }
  std::memcpy(buffer.memory.mapped(), bytes.data(), bytes.size());
}

std::vector<std::uint32_t> packed(const ColourTable& table) {
  std::vector<std::uint32_t> texels;
  for (const glm::vec4& colour : table) texels.push_back(glm::packUnorm4x8(colour));
  return texels;
}

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

FrameRecorder::FrameRecorder(std::shared_ptr<Device::State> device, int samples)
    : device_(std::move(device)),
      samples_(samples == 4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1),
      pipelines_(device_, samples_),
      frame_(device_->memory, sizeof(shared::Frame), Usage::eUniformBuffer, Home::kHost),
      colours_(device_->upload(bytes_of(packed(colour_table(colour_maps().front()))),
                               Usage::eUniformTexelBuffer)),
      colours_view_(device_->device,
                    {{}, *colours_.buffer, vk::Format::eR8G8B8A8Unorm, 0, VK_WHOLE_SIZE}),
      pool_(make_pool(device_->device)),
      set_(make_set(device_->device, *pool_, pipelines_.set_layout())) {
  set_atlas({});
}

void FrameRecorder::set_surface(const DrawMesh& mesh, std::span<const float> values) {
  Buffer vertices = device_->upload(bytes_of(mesh.vertices), Usage::eVertexBuffer);
  Buffer indices = device_->upload(bytes_of(mesh.faces), Usage::eIndexBuffer);
  Buffer made = device_->upload(std::as_bytes(values), Usage::eVertexBuffer);
  vertices_ = std::move(vertices);
  indices_ = std::move(indices);
  values_ = std::move(made);
  index_count_ = static_cast<std::uint32_t>(3 * mesh.faces.size());
}

void FrameRecorder::set_values(std::span<const float> values) {
  device_->update(values_, std::as_bytes(values));
}

void FrameRecorder::set_colours(const ColourTable& table) {
  static_assert(kColourSteps == shared::kColourSteps);
  device_->update(colours_, bytes_of(packed(table)));
}

void FrameRecorder::set_markers(std::span<const Marker> markers) {
  markers_ = device_->upload(std::as_bytes(markers), Usage::eVertexBuffer);
  marker_count_ = static_cast<std::uint32_t>(markers.size());
}

void FrameRecorder::set_atlas(const GlyphAtlas& atlas) {
  if (atlas.pixels() == atlas_pixels_) return;
  const vk::Extent2D extent(static_cast<std::uint32_t>(atlas.width()),
                            static_cast<std::uint32_t>(atlas.height()));
  Texture texture(device_->memory, extent, vk::Format::eR8Unorm,
                  vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst);
  const Buffer staging = device_->upload(bytes_of(atlas.pixels()), Usage::eTransferSrc);
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
  device_->run([&](const vk::raii::CommandBuffer& commands) {
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
  atlas_ = std::move(texture);
  atlas_pixels_ = atlas.pixels();
  write_descriptors();
}

void FrameRecorder::write_descriptors() {
  const vk::DescriptorBufferInfo frame(*frame_.buffer, 0, VK_WHOLE_SIZE);
  const vk::BufferView colours = *colours_view_;
  const vk::DescriptorImageInfo atlas({}, *atlas_.view, vk::ImageLayout::eShaderReadOnlyOptimal);
  using Kind = vk::DescriptorType;
  const std::array writes = {
      vk::WriteDescriptorSet(*set_, shared::kFrameBinding, 0, Kind::eUniformBuffer, {}, frame),
      vk::WriteDescriptorSet(*set_, shared::kColoursBinding, 0, Kind::eUniformTexelBuffer, {}, {},
                             colours),
      vk::WriteDescriptorSet(*set_, shared::kAtlasBinding, 0, Kind::eCombinedImageSampler, atlas)};
  device_->device.updateDescriptorSets(writes, {});
}

void FrameRecorder::prepare(const ArrowSelection& arrows, const Overlay& overlay) {
  std::vector<ArrowInstance> instances = arrows.primary;
  instances.insert(instances.end(), arrows.secondary.begin(), arrows.secondary.end());
  write_host(*device_, arrows_, bytes_of(instances), Usage::eVertexBuffer);
  primary_count_ = static_cast<std::uint32_t>(arrows.primary.size());
  secondary_count_ = static_cast<std::uint32_t>(arrows.secondary.size());
  write_host(*device_, overlay_, bytes_of(overlay.vertices), Usage::eVertexBuffer);
  overlay_count_ = static_cast<std::uint32_t>(overlay.vertices.size());
  if (overlay_count_ > 0) set_atlas(overlay.atlas);
}

template <class Push>
void FrameRecorder::push(const vk::raii::CommandBuffer& commands, const Push& values) {
  static_assert(sizeof(Push) <= sizeof(shared::ArrowPush));
  commands.pushConstants<Push>(pipelines_.layout(), kBothStages, 0, values);
}

void FrameRecorder::record(const TargetFrame& frame, glm::ivec2 extent, const Scene& scene) {
  const vk::raii::CommandBuffer& commands = *frame.commands;
  const vk::Extent2D size(static_cast<std::uint32_t>(extent.x),
                          static_cast<std::uint32_t>(extent.y));
  pipelines_.use_format(frame.format);
  if (!attachments_.fit(size, frame.format)) {
    attachments_ = {};  // first, so that both are never there at once
    attachments_ = Attachments(*device_, size, frame.format, samples_);
  }
  const shared::Frame uniforms = frame_uniforms(scene, frame.origin, extent);
  std::memcpy(frame_.memory.mapped(), &uniforms, sizeof(uniforms));

  commands.setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(extent.x), static_cast<float>(extent.y), 0, 1));
  commands.setScissor(0, vk::Rect2D({0, 0}, size));
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines_.layout(), 0, *set_, {});

  const glm::vec4& b = scene.background;
  const std::array<float, 4> background = {b.r * b.a, b.g * b.a, b.b * b.a, b.a};
  record_scene_begin(commands, attachments_, frame.view, vk::ClearColorValue(background));
  record_scene(commands, scene);
  commands.endRendering();
  if (overlay_count_ == 0) return;
  record_overlay_begin(commands, size, frame.image, frame.view);
  record_overlay(commands);
  commands.endRendering();
}

void FrameRecorder::record_scene(const vk::raii::CommandBuffer& commands, const Scene& scene) {
  if (scene.surface.visible && index_count_ > 0) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics,
                          pipelines_.surface(surface_features(scene)));
    commands.bindVertexBuffers(0, {*vertices_.buffer, *values_.buffer}, {0, 0});
    commands.bindIndexBuffer(*indices_.buffer, 0, vk::IndexType::eUint32);
    commands.drawIndexed(index_count_, 1, 0, 0, 0);
  }
  record_arrows(commands, scene.arrows);
  if (scene.markers.visible && marker_count_ > 0) record_markers(commands);
}

void FrameRecorder::record_arrows(const vk::raii::CommandBuffer& commands,
                                  const ArrowStyle& style) {
  if (primary_count_ + secondary_count_ == 0) return;
  constexpr std::uint32_t kVerticesOfAnArrow = 9;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.arrows());
  commands.bindVertexBuffers(0, *arrows_.buffer, {0});
  if (primary_count_ > 0) {
    push(commands, shared::ArrowPush{glm::vec4(style.primary_colour, 1), kLift});
    commands.draw(kVerticesOfAnArrow, primary_count_, 0, 0);
  }
  if (secondary_count_ > 0) {
    push(commands, shared::ArrowPush{glm::vec4(style.secondary_colour, 1), kLiftOfSecond});
    commands.draw(kVerticesOfAnArrow, secondary_count_, 0, primary_count_);
  }
}

void FrameRecorder::record_markers(const vk::raii::CommandBuffer& commands) {
  commands.bindVertexBuffers(0, *markers_.buffer, {0});
  const auto draw = [&](vk::Pipeline pipeline, float opacity) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    for (const float inside : {0.0F, 1.0F}) {
      push(commands, shared::MarkerPush{opacity, inside});
      commands.draw(4, marker_count_, 0, 0);
    }
  };
  draw(pipelines_.hidden_markers(), kHiddenOpacity);
  draw(pipelines_.visible_markers(), 1);
}

void FrameRecorder::record_overlay(const vk::raii::CommandBuffer& commands) {
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.overlay());
  commands.bindVertexBuffers(0, *overlay_.buffer, {0});
  commands.draw(overlay_count_, 1, 0, 0);
}

}  // namespace geotherm::engine
