// SPDX-License-Identifier: MIT
#include "engine/vulkan/frame_recorder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "engine/vulkan/device_state.h"
#include "shaders/shared.h"

namespace geotherm::engine {
namespace {

using Usage = vk::BufferUsageFlagBits;
/// Arrows towards the eye, in their full lengths; the second field lies on the first.
constexpr float kLift = 0.35F;
constexpr float kLiftOfSecond = 0.42F;

std::vector<std::uint32_t> packed(const ColourTable& table) {
  std::vector<std::uint32_t> texels;
  for (const glm::vec4& colour : table) texels.push_back(glm::packUnorm4x8(colour));
  return texels;
}

vk::SampleCountFlagBits sample_count(int samples) {
  assert(samples == 1 || samples == 4);
  return samples == 4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1;
}

/// Pixels that a length of 1 covers in the middle of the model.
float pixels_per_scene(const Camera& camera) {
  const float depth = camera.orthographic ? 1 : std::max(-camera.view[3].z, 1e-4F);
  return camera.pixels_per_unit / depth;
}

/// The target's pixels that belong to the picture: beside it there are panels.
vk::Rect2D picture_in(glm::ivec2 extent, glm::ivec2 origin, const Camera& camera) {
  const glm::ivec2 from = glm::clamp(-origin, glm::ivec2(0), extent);
  const glm::ivec2 to = glm::clamp(glm::ivec2(glm::ceil(camera.extent)) - origin, from, extent);
  const glm::uvec2 size(to - from);
  return {{from.x, from.y}, {size.x, size.y}};
}

}  // namespace

FrameRecorder::FrameRecorder(std::shared_ptr<Device::State> device, int samples)
    : device_(std::move(device)),
      samples_(sample_count(samples)),
      pipelines_(device_),
      frame_(device_->memory, sizeof(shared::Frame), Usage::eUniformBuffer, Home::kHost),
      colours_(device_->upload(bytes_of(packed(colour_table(colour_maps().front()))),
                               Usage::eUniformTexelBuffer)),
      colours_view_(device_->device,
                    {{}, *colours_.buffer, vk::Format::eR8G8B8A8Unorm, 0, VK_WHOLE_SIZE}),
      sampler_(make_sampler(device_->device, vk::Filter::eNearest)),
      descriptors_(device_->device, pipelines_.set_layout()),
      panels_(device_, pipelines_.set_layout()) {
  set_atlas({});
}

void FrameRecorder::set_samples(int samples) { samples_ = sample_count(samples); }

void FrameRecorder::set_surface(const DrawMesh& mesh, std::span<const float> values) {
  Surface made;
  made.vertices = device_->upload(bytes_of(mesh.vertices), Usage::eVertexBuffer);
  made.indices = device_->upload(bytes_of(mesh.faces), Usage::eIndexBuffer);
  made.values = device_->upload(std::as_bytes(values), Usage::eVertexBuffer);
  made.index_count = static_cast<std::uint32_t>(3 * mesh.faces.size());
  *surface_ = std::move(made);
  if (surface_ != &surfaces_[0]) return;
  line_ranges_.clear();
  marker_count_ = 0;
}

void FrameRecorder::set_vertices(std::span<const DrawMesh::Vertex> vertices) {
  device_->update(surface_->vertices, std::as_bytes(vertices));
  surface_->face_vertices = {};
  surface_->face_values = {};
}

void FrameRecorder::set_values(std::span<const float> values) {
  device_->update(surface_->values, std::as_bytes(values));
}

void FrameRecorder::set_regions(std::span<const glm::vec3> values_regions_margins) {
  const auto bytes = std::as_bytes(values_regions_margins);
  Buffer& regions = surface_->regions;
  if (bytes.empty()) {
    regions = {};
  } else if (regions.bytes == bytes.size()) {
    device_->update(regions, bytes);
  } else {
    regions = device_->upload(bytes, Usage::eVertexBuffer);
  }
}

void FrameRecorder::set_separate_faces(std::span<const DrawMesh::Vertex> vertices,
                                       std::span<const float> values) {
  Buffer made = device_->upload(std::as_bytes(vertices), Usage::eVertexBuffer);
  surface_->face_values = device_->upload(std::as_bytes(values), Usage::eVertexBuffer);
  surface_->face_vertices = std::move(made);
}

void FrameRecorder::set_face_values(std::span<const float> values) {
  if (!values.empty()) return device_->update(surface_->face_values, std::as_bytes(values));
  surface_->face_vertices = {};
  surface_->face_values = {};
}

void FrameRecorder::set_colours(const ColourTable& table) {
  static_assert(kColourSteps == shared::kColourSteps);
  device_->update(colours_, bytes_of(packed(table)));
}

void FrameRecorder::set_lines(const LineSet& lines) {
  write_host(*device_, lines_, bytes_of(lines.pieces()), Usage::eVertexBuffer);
  line_ranges_ = lines.ranges();
}

void FrameRecorder::set_markers(std::span<const Marker> markers) {
  markers_ = device_->upload(std::as_bytes(markers), Usage::eVertexBuffer);
  marker_count_ = static_cast<std::uint32_t>(markers.size());
}

void FrameRecorder::set_atlas(const GlyphAtlas& atlas) {
  if (atlas.pixels() == atlas_pixels_) return;
  atlas_ = upload_coverage(
      *device_,
      {static_cast<std::uint32_t>(atlas.width()), static_cast<std::uint32_t>(atlas.height())},
      atlas.pixels());
  atlas_pixels_ = atlas.pixels();
  write_descriptors();
}

void FrameRecorder::write_descriptors() {
  const vk::DescriptorBufferInfo frame(*frame_.buffer, 0, VK_WHOLE_SIZE);
  const vk::BufferView colours = *colours_view_;
  const vk::DescriptorImageInfo atlas(*sampler_, *atlas_.view,
                                      vk::ImageLayout::eShaderReadOnlyOptimal);
  using Kind = vk::DescriptorType;
  const std::array writes = {vk::WriteDescriptorSet(*descriptors_.set, shared::kFrameBinding, 0,
                                                    Kind::eUniformBuffer, {}, frame),
                             vk::WriteDescriptorSet(*descriptors_.set, shared::kColoursBinding, 0,
                                                    Kind::eUniformTexelBuffer, {}, {}, colours),
                             vk::WriteDescriptorSet(*descriptors_.set, shared::kAtlasBinding, 0,
                                                    Kind::eCombinedImageSampler, atlas)};
  device_->device.updateDescriptorSets(writes, {});
}

void FrameRecorder::prepare(const ArrowSelection& arrows, const Overlay& overlay,
                            const PanelDraw* panels) {
  std::vector<ArrowInstance> instances = arrows.primary;
  instances.insert(instances.end(), arrows.secondary.begin(), arrows.secondary.end());
  write_host(*device_, arrows_, bytes_of(instances), Usage::eVertexBuffer);
  primary_count_ = static_cast<std::uint32_t>(arrows.primary.size());
  secondary_count_ = static_cast<std::uint32_t>(arrows.secondary.size());
  write_host(*device_, overlay_, bytes_of(overlay.vertices), Usage::eVertexBuffer);
  overlay_count_ = static_cast<std::uint32_t>(overlay.vertices.size());
  if (overlay_count_ > 0) set_atlas(overlay.atlas);
  panels_.prepare(panels);
}

template <class Push>
void FrameRecorder::push(const vk::raii::CommandBuffer& commands, const Push& values) {
  static_assert(sizeof(Push) <= sizeof(shared::LinePush));
  commands.pushConstants<Push>(pipelines_.layout(), Pipelines::kPushStages, 0, values);
}

const Attachments& FrameRecorder::fitting_attachments(vk::Extent2D size, vk::Format format) {
  for (Attachments& kept : attachments_) {
    if (!kept.fit(size, format)) kept = {};  // first, so that both are never there at once
  }
  Attachments& own = attachments_[samples_ == vk::SampleCountFlagBits::e1 ? 0 : 1];
  if (!own.fit(size, format)) own = Attachments(*device_, size, format, samples_);
  return own;
}

void FrameRecorder::record(const TargetFrame& frame, glm::ivec2 extent, const Scene& scene,
                           SceneUse use) {
  const vk::raii::CommandBuffer& commands = *frame.commands;
  const vk::Extent2D size(static_cast<std::uint32_t>(extent.x),
                          static_cast<std::uint32_t>(extent.y));
  pipelines_.use(frame.format, samples_);
  const shared::Frame uniforms = frame_uniforms(scene, frame.origin, extent);
  std::memcpy(frame_.memory.mapped(), &uniforms, sizeof(uniforms));

  commands.setViewport(
      0, vk::Viewport(0, 0, static_cast<float>(extent.x), static_cast<float>(extent.y), 0, 1));
  commands.setScissor(0, picture_in(extent, frame.origin, scene.camera));
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines_.layout(), 0,
                              *descriptors_.set, {});
  if (use == SceneUse::kOnce || !frame.copyable) {
    record_new_scene(frame, size, scene, frame.view);
  } else {
    const bool fits = kept_.picture.extent == size && kept_.format == frame.format;
    if (!fits) {
      kept_ = {};  // first, so that both are never there at once
      using ImageUsage = vk::ImageUsageFlagBits;
      kept_ = {Texture(device_->memory, size, frame.format,
                       ImageUsage::eColorAttachment | ImageUsage::eTransferSrc),
               frame.format};
    }
    if (!fits || use == SceneUse::kKeep) {
      using Stage = vk::PipelineStageFlagBits2;
      using Access = vk::AccessFlagBits2;
      using Layout = vk::ImageLayout;
      constexpr auto kDraws = Stage::eColorAttachmentOutput;
      record_transition(commands,
                        {*kept_.picture.image, Layout::eUndefined, Layout::eColorAttachmentOptimal,
                         Stage::eCopy, Access::eNone, kDraws, Access::eColorAttachmentWrite});
      record_new_scene(frame, size, scene, *kept_.picture.view);
      record_transition(
          commands,
          {*kept_.picture.image, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal,
           kDraws, Access::eColorAttachmentWrite, Stage::eCopy, Access::eTransferRead});
    }
    record_copy(commands, size, *kept_.picture.image, frame.image);
  }
  if (overlay_count_ == 0 && panels_.empty()) return;
  record_overlay_begin(commands, size, frame.image, frame.view);
  if (overlay_count_ > 0) record_overlay(commands);
  panels_.record(commands, pipelines_, extent);
  commands.endRendering();
}

void FrameRecorder::record_new_scene(const TargetFrame& frame, vk::Extent2D size,
                                     const Scene& scene, vk::ImageView onto) {
  const Attachments& attachments = fitting_attachments(size, frame.format);
  const glm::vec4& b = scene.background;
  const std::array<float, 4> background = {b.r * b.a, b.g * b.a, b.b * b.a, b.a};
  record_scene_begin(*frame.commands, attachments, onto, vk::ClearColorValue(background));
  record_scene(*frame.commands, scene);
  frame.commands->endRendering();
}

void FrameRecorder::record_scene(const vk::raii::CommandBuffer& commands, const Scene& scene) {
  if (scene.surface.visible && surface_->index_count > 0) record_surface(commands, scene);
  if (scene.lines.visible) record_lines(commands, scene, true);
  record_arrows(commands, scene.arrows);
  if (scene.lines.visible) record_lines(commands, scene, false);
  if (scene.markers.visible && marker_count_ > 0) record_markers(commands, scene.markers);
}

void FrameRecorder::record_surface(const vk::raii::CommandBuffer& commands, const Scene& scene) {
  std::uint32_t features = surface_features(scene);
  if (surface_->regions.bytes == 0) features &= ~shared::kRegions;
  if (surface_ != &surfaces_[0]) features &= ~shared::kWire;  // its edges are not the model's
  if (scene.surface.paint == Paint::kFaces) {
    if (has_face_values()) return record_faces(commands, features);
    features &= ~shared::kMapped;
  }
  const Buffer& values = (features & shared::kRegions) != 0 ? surface_->regions : surface_->values;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.surface(features));
  commands.bindVertexBuffers(0, {*surface_->vertices.buffer, *values.buffer}, {0, 0});
  commands.bindIndexBuffer(*surface_->indices.buffer, 0, vk::IndexType::eUint32);
  commands.drawIndexed(surface_->index_count, 1, 0, 0, 0);
}

void FrameRecorder::record_faces(const vk::raii::CommandBuffer& commands, std::uint32_t features) {
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.surface(features));
  commands.bindVertexBuffers(0, {*surface_->face_vertices.buffer, *surface_->face_values.buffer},
                             {0, 0});
  commands.draw(surface_->index_count, 1, 0, 0);
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

void FrameRecorder::record_lines(const vk::raii::CommandBuffer& commands, const Scene& scene,
                                 bool hidden) {
  if (line_ranges_.empty()) return;
  const LineStyle& style = scene.lines;
  const float thinner = hidden ? style.hidden_width : 1;
  const float half = 0.5F * style.width * scene.pixel_scale * thinner;
  const float with_rim = half + style.rim * scene.pixel_scale * thinner;
  const float dash = hidden ? style.dash * scene.pixel_scale / pixels_per_scene(scene.camera) : 0;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.lines(hidden));
  commands.bindVertexBuffers(0, *lines_.buffer, {0});
  for (const LineSet::Range& line : line_ranges_) {
    const auto draw = [&](const glm::vec3& colour, float half_width) {
      const float opacity = hidden ? style.hidden_opacity : 1;
      push(commands, shared::LinePush{glm::vec4(colour, 1) * opacity, half_width, dash});
      commands.draw(4, line.count, 0, line.first);
    };
    if (style.rim > 0) draw(style.rim_about(line.colour), with_rim);
    draw(line.colour, half);
  }
}

void FrameRecorder::record_markers(const vk::raii::CommandBuffer& commands,
                                   const MarkerStyle& style) {
  commands.bindVertexBuffers(0, *markers_.buffer, {0});
  const auto draw = [&](vk::Pipeline pipeline, float opacity) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
    for (const float inside : {0.0F, 1.0F}) {
      push(commands, shared::MarkerPush{opacity, inside});
      commands.draw(4, marker_count_, 0, 0);
    }
  };
  draw(pipelines_.markers(true), style.hidden_opacity);
  draw(pipelines_.markers(false), 1);
}

void FrameRecorder::record_overlay(const vk::raii::CommandBuffer& commands) {
  if (overlay_count_ == 0) return;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipelines_.overlay());
  commands.bindVertexBuffers(0, *overlay_.buffer, {0});
  commands.draw(overlay_count_, 1, 0, 0);
}

}  // namespace geotherm::engine
