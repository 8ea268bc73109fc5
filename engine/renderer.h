// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "engine/device.h"
#include "engine/overlay/overlay.h"
#include "engine/overlay/panel_draw.h"
#include "engine/scene/colour_map.h"
#include "engine/scene/scene.h"
#include "engine/target.h"
#include "geotherm/error.h"

namespace geotherm::engine {

/// Draws one model. Geometry is uploaded once; values, regions, colours, arrows, lines and markers
/// are replaced without touching it. Every call may fail with kOutOfMemory or kNoDevice (device
/// lost); after a failure what was there before is still there.
class Renderer {
 public:
  /// samples: 1 or 4 a pixel.
  static Result<Renderer> build(const Device& device, int samples = 4);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// Replaces the model; all that was set on it is gone. Cost: normals and creases of all
  /// faces, then the upload.
  Result<void> set_surface(const SurfaceGeometry& geometry);
  /// One value a vertex (kNoValue: none). Cost: a copy of V floats.
  Result<void> set_values(std::span<const float> values);
  /// One place in the colours a vertex, -1 where there is none (Paint::kRegions); empty: no
  /// regions.
  Result<void> set_regions(std::span<const std::int32_t> regions);
  /// One value a face (kNoValue: none), for Paint::kFaces; empty: no such values. Cost: those after
  /// none take as long as set_surface(), and three vertices a face of the device's memory.
  Result<void> set_face_values(std::span<const float> values);
  Result<void> set_colours(const ColourTable& table);
  /// One vector a face, each field empty or F long; a zero vector draws no arrow. Lengths are the
  /// arrows' share of full size, 0 to 1.
  Result<void> set_arrows(std::span<const glm::vec3> primary, std::span<const glm::vec3> secondary);
  /// A later line lies over the earlier ones. Points that are not finite cut it in two;
  /// those that a view does not resolve are not drawn (LineSet).
  Result<void> set_lines(std::span<const Polyline> lines);
  Result<void> set_markers(std::span<const Marker> markers);

  /// The letters of all panels drawn from now on; nothing happens when the version is the same.
  Result<void> set_panel_font(const PanelFont& font);

  /// What of the target lies beside the picture shows the scene's background. `panels` lie over
  /// all, in pixels of the target whatever part of the picture it shows. Precondition:
  /// set_panel_font() where there are panels.
  Result<void> render(Target& target, const Scene& scene, const Overlay& overlay = {},
                      const PanelDraw* panels = nullptr);

  int samples() const;
  /// 1 or 4, from the next frame on; what is made for either is kept, so that turning is free.
  void set_samples(int samples);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::engine
