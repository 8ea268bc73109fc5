// SPDX-License-Identifier: MIT
#include "engine/vulkan/frame_recorder.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/vulkan/device_state.h"
#include "engine/vulkan/pipelines.h"
#include "shaders/shared.h"

namespace geotherm::engine {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;
using ImageUsage = vk::ImageUsageFlagBits;

}  // namespace

Attachments::Attachments(const Device::State& device, vk::Extent2D size, vk::Format colour_format,
                         vk::SampleCountFlagBits samples)
    : extent(size),
      format(colour_format),
      depth(device.memory, size, Pipelines::kDepthFormat,
            ImageUsage::eDepthStencilAttachment | ImageUsage::eTransientAttachment, samples) {
  if (samples == vk::SampleCountFlagBits::e1) return;
  colour = Texture(device.memory, size, colour_format,
                   ImageUsage::eColorAttachment | ImageUsage::eTransientAttachment, samples);
}

void record_scene_begin(const vk::raii::CommandBuffer& commands, const Attachments& attachments,
                        vk::ImageView target, const vk::ClearColorValue& background) {
  // What an earlier frame left in them does not matter, only that it is finished.
  constexpr auto kDepthStages = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;
  record_transition(commands,
                    {*attachments.depth.image, Layout::eUndefined, Layout::eDepthAttachmentOptimal,
                     kDepthStages, Access::eDepthStencilAttachmentWrite, kDepthStages,
                     Access::eDepthStencilAttachmentWrite | Access::eDepthStencilAttachmentRead,
                     vk::ImageAspectFlagBits::eDepth});
  const bool resolves = static_cast<bool>(*attachments.colour.image);
  if (resolves) {
    record_transition(commands, {*attachments.colour.image, Layout::eUndefined,
                                 Layout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                                 Access::eColorAttachmentWrite, Stage::eColorAttachmentOutput,
                                 Access::eColorAttachmentWrite | Access::eColorAttachmentRead});
  }
  vk::RenderingAttachmentInfo colour(resolves ? *attachments.colour.view : target,
                                     Layout::eColorAttachmentOptimal);
  colour.setLoadOp(vk::AttachmentLoadOp::eClear).setClearValue(background);
  colour.setStoreOp(resolves ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore);
  if (resolves) {
    colour.setResolveMode(vk::ResolveModeFlagBits::eAverage)
        .setResolveImageView(target)
        .setResolveImageLayout(Layout::eColorAttachmentOptimal);
  }
  vk::RenderingAttachmentInfo depth(*attachments.depth.view, Layout::eDepthAttachmentOptimal);
  depth.setLoadOp(vk::AttachmentLoadOp::eClear)
      .setStoreOp(vk::AttachmentStoreOp::eDontCare)
      .setClearValue(vk::ClearDepthStencilValue(0.0F, 0));
  commands.beginRendering({{}, {{0, 0}, attachments.extent}, 1, 0, colour, &depth});
}

void record_overlay_begin(const vk::raii::CommandBuffer& commands, vk::Extent2D extent,
                          vk::Image image, vk::ImageView target) {
  record_transition(commands, {image, Layout::eColorAttachmentOptimal,
                               Layout::eColorAttachmentOptimal, Stage::eColorAttachmentOutput,
                               Access::eColorAttachmentWrite, Stage::eColorAttachmentOutput,
                               Access::eColorAttachmentWrite | Access::eColorAttachmentRead});
  vk::RenderingAttachmentInfo colour(target, Layout::eColorAttachmentOptimal);
  colour.setLoadOp(vk::AttachmentLoadOp::eLoad).setStoreOp(vk::AttachmentStoreOp::eStore);
  commands.beginRendering({{}, {{0, 0}, extent}, 1, 0, colour});
}

void record_copy(const vk::raii::CommandBuffer& commands, vk::Extent2D extent, vk::Image kept,
                 vk::Image target) {
  constexpr auto kDraws = Stage::eColorAttachmentOutput;
  record_transition(commands,
                    {target, Layout::eColorAttachmentOptimal, Layout::eTransferDstOptimal, kDraws,
                     Access::eColorAttachmentWrite, Stage::eCopy, Access::eTransferWrite});
  const vk::ImageSubresourceLayers all(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
  const vk::ImageCopy whole(all, {}, all, {}, {extent.width, extent.height, 1});
  commands.copyImage(kept, Layout::eTransferSrcOptimal, target, Layout::eTransferDstOptimal, whole);
  record_transition(commands, {target, Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal,
                               Stage::eCopy, Access::eTransferWrite, kDraws,
                               Access::eColorAttachmentWrite | Access::eColorAttachmentRead});
}

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

namespace {

/// Isolines closer than this share of the colours' range cannot be seen, and their numbers leave
/// what shaders compute with.
constexpr float kClosestLines = 1e-6F;

bool has_isolines(const SurfaceStyle& surface) {
  if (!surface.levels.empty()) return false;  // lines are those
  const float width = std::abs(surface.range_max - surface.range_min);
  const float reach = std::max({width, std::abs(surface.range_min), std::abs(surface.range_max)});
  return surface.line_spacing > kClosestLines * reach;
}

}  // namespace

shared::Frame frame_uniforms(const Scene& scene, glm::vec2 origin, glm::vec2 extent) {
  const SurfaceStyle& surface = scene.surface;
  const float width = surface.range_max - surface.range_min;
  shared::Frame frame{};
  frame.clip_from_scene = scene.camera.projection * scene.camera.view;
  frame.eye_from_scene = scene.camera.view;
  frame.extent = scene.camera.extent;
  frame.near_shift = 2;  // seen whole on surfaces inclined by up to 63 degrees
  const glm::vec2 magnified = scene.camera.extent / extent;
  frame.tile = {magnified, magnified - 2.0F * origin / extent - 1.0F};
  frame.orthographic = scene.camera.orthographic ? 1 : 0;
  const float scale = has_isolines(surface) ? 1 / surface.line_spacing : 1;
  if (surface.log) {
    const float low = std::log2(surface.range_min + surface.log_offset);
    const float octaves = std::log2(surface.range_max + surface.log_offset) - low;
    const float per_octave = octaves != 0 ? 1 / octaves : 0;
    frame.range = {per_octave, -(low + std::log2(scale)) * per_octave, scale,
                   surface.log_offset * scale};
  } else {
    const float per_width = width != 0 ? 1 / width : 0;
    frame.range = {per_width / scale, -surface.range_min * per_width, scale, 0};
  }
  const std::size_t levels = std::min(surface.levels.size(), kMaxLevels);
  frame.level_count = {levels, surface.bands, 0, 0};
  for (std::size_t i = 0; i < levels; ++i) {
    frame.levels[i / 4][static_cast<int>(i % 4)] = surface.levels[i];
  }
  frame.plain = {surface.colour, 1};
  frame.line = {surface.line_colour, surface.line_width * scene.pixel_scale};
  frame.wire = {surface.wire_colour, surface.wire_width * scene.pixel_scale};
  frame.marker = {scene.markers.colour, scene.markers.radius * scene.pixel_scale};
  frame.marker_rim = {scene.markers.rim, scene.markers.inside};
  const float half = 0.5F * scene.lines.width * scene.pixel_scale;
  frame.polyline = {half, half + scene.lines.rim * scene.pixel_scale, origin};
  if (!scene.camera.orthographic) {
    // From a pixel of the target to the direction in which the eye sees it.
    const glm::mat4& p = scene.camera.projection;
    const glm::vec2 tangent(1 / p[0][0], 1 / p[1][1]);  // of half the picture
    const glm::vec2 per_pixel = 2.0F * tangent / scene.camera.extent;
    const glm::vec2 shift(p[2][0], p[2][1]);
    frame.sight = {per_pixel, per_pixel * origin - tangent * (1.0F - shift)};
  }
  return frame;
}

std::uint32_t surface_features(const Scene& scene) {
  const SurfaceStyle& surface = scene.surface;
  std::uint32_t features = 0;
  if (scene.light == Light::kNone) features |= shared::kNoLight;
  if (scene.light == Light::kThreePoint) features |= shared::kThreeLights;
  if (!surface.smooth && scene.light != Light::kNone) features |= shared::kFlat;
  if (surface.paint == Paint::kMap || surface.paint == Paint::kFaces) features |= shared::kMapped;
  if (surface.paint == Paint::kRegions) features |= shared::kRegions;
  if (has_isolines(surface)) features |= shared::kIsolines;
  if (!surface.levels.empty()) features |= shared::kLevels;
  if (surface.log && surface.paint == Paint::kMap) features |= shared::kLogarithmic;
  if (surface.wire) features |= shared::kWire;
  if (surface.form && scene.light != Light::kNone) features |= shared::kForm;
  return features;
}

}  // namespace geotherm::engine
