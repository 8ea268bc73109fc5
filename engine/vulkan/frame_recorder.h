// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "engine/overlay/overlay.h"
#include "engine/scene/arrow_selection.h"
#include "engine/scene/colour_map.h"
#include "engine/scene/draw_mesh.h"
#include "engine/scene/line_set.h"
#include "engine/vulkan/attachments.h"
#include "engine/vulkan/descriptors.h"
#include "engine/vulkan/device_state.h"
#include "engine/vulkan/panel_layer.h"
#include "engine/vulkan/pipelines.h"
#include "engine/vulkan/target_frame.h"

namespace geotherm::engine {

/// What of a renderer lives on the device, and the commands that draw it. Nothing may be drawing
/// while it is changed or prepared: there is one copy of each buffer, so targets wait for a frame
/// before they begin the next. Methods throw and then leave what was there.
class FrameRecorder {
 public:
  FrameRecorder(std::shared_ptr<Device::State> device, int samples);

  int samples() const { return static_cast<int>(samples_); }
  void set_samples(int samples);  ///< 1 or 4

  /// All that was set on the surface before is gone.
  void set_surface(const DrawMesh& mesh, std::span<const float> values);
  void set_values(std::span<const float> values);  ///< as many as set_surface() had
  void set_regions(std::span<const glm::vec2> values_and_regions);  ///< as many, or none
  /// Vertices of faces for themselves (separate_faces()) with their values.
  void set_separate_faces(std::span<const DrawMesh::Vertex> vertices,
                          std::span<const float> values);
  void set_face_values(std::span<const float> values);  ///< as many as there were, or none
  bool has_face_values() const { return face_values_.bytes > 0; }
  void set_colours(const ColourTable& table);
  void set_lines(const LineSet& lines);
  void set_markers(std::span<const Marker> markers);
  void set_panel_font(const PanelFont& font) { panels_.set_font(font); }

  /// Uploads what only this frame needs; before the target's begin().
  void prepare(const ArrowSelection& arrows, const Overlay& overlay, const PanelDraw* panels);
  void record(const TargetFrame& frame, glm::ivec2 extent, const Scene& scene);

 private:
  void set_atlas(const GlyphAtlas& atlas);
  void write_descriptors();
  const Attachments& fitting_attachments(vk::Extent2D size, vk::Format format);
  void record_scene(const vk::raii::CommandBuffer& commands, const Scene& scene);
  void record_arrows(const vk::raii::CommandBuffer& commands, const ArrowStyle& style);
  void record_surface(const vk::raii::CommandBuffer& commands, const Scene& scene);
  void record_faces(const vk::raii::CommandBuffer& commands, std::uint32_t features);
  void record_lines(const vk::raii::CommandBuffer& commands, const Scene& scene);
  void record_markers(const vk::raii::CommandBuffer& commands);
  void record_overlay(const vk::raii::CommandBuffer& commands);
  template <class Push>
  void push(const vk::raii::CommandBuffer& commands, const Push& values);

  // Members are destroyed from the last to the first.
  std::shared_ptr<Device::State> device_;
  vk::SampleCountFlagBits samples_;
  Pipelines pipelines_;
  std::array<Attachments, 2> attachments_;  ///< with one sample a pixel, with four
  Buffer frame_, colours_, vertices_, values_, regions_, indices_;
  Buffer face_vertices_, face_values_;  ///< three a face; empty: not needed
  Buffer lines_, markers_, arrows_, overlay_;
  std::vector<LineSet::Range> line_ranges_;
  vk::raii::BufferView colours_view_ = nullptr;  ///< of colours_
  vk::raii::Sampler sampler_;
  Texture atlas_;
  std::vector<std::uint8_t> atlas_pixels_;  ///< what is in atlas_
  std::uint32_t index_count_ = 0, marker_count_ = 0, overlay_count_ = 0;
  std::uint32_t primary_count_ = 0, secondary_count_ = 0;
  Descriptors descriptors_;
  PanelLayer panels_;
};

}  // namespace geotherm::engine
