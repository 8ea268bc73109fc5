// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "engine/overlay/overlay.h"
#include "engine/renderer.h"
#include "engine/scene/arrows.h"
#include "engine/scene/colours.h"
#include "engine/scene/draw_mesh.h"
#include "engine/scene/line_set.h"
#include "engine/scene/scene.h"
#include "engine/scene/uniforms.h"
#include "engine/target.h"
#include "engine/vulkan/device_state.h"
#include "engine/vulkan/pipelines.h"
#include "engine/vulkan/vulkan.h"
#include "shaders/shared.h"

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

/// Copies a picture that was kept, in the layout eTransferSrcOptimal, to the target.
void record_copy(const vk::raii::CommandBuffer& commands, vk::Extent2D extent, vk::Image kept,
                 vk::Image target);

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

/// What of a renderer lives on the device, and the commands that draw it. Nothing may be drawing
/// while it is changed or prepared: there is one copy of each buffer, so targets wait for a frame
/// before they begin the next. Methods throw and then leave what was there.
class FrameRecorder {
 public:
  FrameRecorder(std::shared_ptr<Device::State> device, int samples);

  void set_samples(int samples);  ///< 1 or 4

  /// Which of the two surfaces the calls below set, and record() draws.
  void use_coarse(bool coarse) { surface_ = coarse ? &surfaces_[1] : &surfaces_[0]; }

  /// All that was set on the surface before is gone.
  void set_surface(const DrawMesh& mesh, std::span<const float> values);
  /// As many as set_surface() had; vertices of separate faces are gone.
  void set_vertices(std::span<const DrawMesh::Vertex> vertices);
  void set_values(std::span<const float> values);  ///< as many as set_surface() had
  /// Values, regions, margins: as many, or none.
  void set_regions(std::span<const glm::vec3> values_regions_margins);
  /// Vertices of faces for themselves (separate_faces()) with their values.
  void set_separate_faces(std::span<const DrawMesh::Vertex> vertices,
                          std::span<const float> values);
  void set_face_values(std::span<const float> values);  ///< as many as there were, or none
  bool has_face_values() const { return surface_->face_values.bytes > 0; }
  void set_colours(const ColourTable& table);
  void set_lines(const LineSet& lines);
  void set_markers(std::span<const Marker> markers);
  void set_panel_font(const PanelFont& font) { panels_.set_font(font); }

  /// Uploads what only this frame needs; before the target's begin().
  void prepare(const ArrowSelection& arrows, const Overlay& overlay, const PanelDraw* panels);
  void record(const TargetFrame& frame, glm::ivec2 extent, const Scene& scene, SceneUse use);

 private:
  void set_atlas(const GlyphAtlas& atlas);
  void write_descriptors();
  const Attachments& fitting_attachments(vk::Extent2D size, vk::Format format);
  void record_scene(const vk::raii::CommandBuffer& commands, const Scene& scene);
  void record_new_scene(const TargetFrame& frame, vk::Extent2D size, const Scene& scene,
                        vk::ImageView onto);
  void record_arrows(const vk::raii::CommandBuffer& commands, const ArrowStyle& style);
  void record_surface(const vk::raii::CommandBuffer& commands, const Scene& scene);
  void record_faces(const vk::raii::CommandBuffer& commands, std::uint32_t features);
  void record_lines(const vk::raii::CommandBuffer& commands, const Scene& scene, bool hidden);
  void record_markers(const vk::raii::CommandBuffer& commands, const MarkerStyle& style);
  void record_overlay(const vk::raii::CommandBuffer& commands);
  template <class Push>
  void push(const vk::raii::CommandBuffer& commands, const Push& values);

  // Members are destroyed from the last to the first.
  std::shared_ptr<Device::State> device_;
  vk::SampleCountFlagBits samples_;
  Pipelines pipelines_;
  std::array<Attachments, 2> attachments_;  ///< with one sample a pixel, with four
  struct Kept {
    Texture picture;
    vk::Format format = vk::Format::eUndefined;
  };
  Kept kept_;  ///< the scene of SceneUse::kKeep
  Buffer frame_, colours_;
  struct Surface {
    Buffer vertices, values, regions, indices;
    Buffer face_vertices, face_values;  ///< three a face; empty: not needed
    std::uint32_t index_count = 0;
  };
  std::array<Surface, 2> surfaces_;  ///< the model's, and the coarse one
  Surface* surface_ = &surfaces_[0];
  Buffer lines_, markers_, arrows_, overlay_;
  std::vector<LineSet::Range> line_ranges_;
  vk::raii::BufferView colours_view_ = nullptr;  ///< of colours_
  vk::raii::Sampler sampler_;
  Texture atlas_;
  std::vector<std::uint8_t> atlas_pixels_;  ///< what is in atlas_
  std::uint32_t marker_count_ = 0, overlay_count_ = 0;
  std::uint32_t primary_count_ = 0, secondary_count_ = 0;
  Descriptors descriptors_;
  PanelLayer panels_;
};

}  // namespace geotherm::engine
