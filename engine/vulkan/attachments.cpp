// SPDX-License-Identifier: MIT
#include "engine/vulkan/attachments.h"

#include "engine/vulkan/pipelines.h"

namespace geotherm::engine {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;
using Usage = vk::ImageUsageFlagBits;

}  // namespace

Attachments::Attachments(const Device::State& device, vk::Extent2D size, vk::Format colour_format,
                         vk::SampleCountFlagBits samples)
    : extent(size),
      format(colour_format),
      depth(device.memory, size, Pipelines::kDepthFormat,
            Usage::eDepthStencilAttachment | Usage::eTransientAttachment, samples) {
  if (samples == vk::SampleCountFlagBits::e1) return;
  colour = Texture(device.memory, size, colour_format,
                   Usage::eColorAttachment | Usage::eTransientAttachment, samples);
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

}  // namespace geotherm::engine
