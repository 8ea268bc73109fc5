// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/device.h"
#include "engine/overlay/overlay.h"
#include "engine/scene/colours.h"
#include "engine/scene/scene.h"
#include "engine/target.h"
#include "geotherm/error.h"

namespace geotherm::engine {

/// One letter image for panels, 8-bit coverage; `version` changes with its content.
struct PanelFont {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
  std::uint64_t version = 0;
};

/// Triangles of panels, drawn over everything: the layout of ImDrawVert and ImDrawIdx.
struct PanelDraw {
  struct Vertex {
    glm::vec2 position;  ///< pixels from the top left corner of the target
    glm::vec2 uv;        ///< in the font's image
    /// sRGB and alpha, not multiplied in: red is the lowest byte, alpha the highest.
    std::uint32_t colour = 0;
  };
  struct Command {
    glm::vec4 clip;  ///< left, top, right, bottom, pixels
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t vertex_offset = 0;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint16_t> indices;
  std::vector<Command> commands;
};

/// What is done with the picture of a scene without overlay and panels.
enum class SceneUse {
  kOnce,
  kKeep,   ///< drawn, and kept for the next frame
  kAgain,  ///< the scene is the one that was kept: it is not drawn again where it fits
};

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
  /// The same model with its vertices elsewhere, as many as set_surface() had; all else that was
  /// set has to be set again. Cost: the first time that of set_surface(), then what has moved and a
  /// copy of V vertices.
  Result<void> move_surface(std::span<const glm::vec3> positions,
                            std::span<const Openness> openness = {});
  /// Replaces what light comes to the vertices: V. Everything else that was set stays. Cost: that
  /// of set_surface() without the faces, or a copy of V vertices of a model that has moved.
  Result<void> set_openness(std::span<const Openness> openness);
  /// One value a vertex (kNoValue: none). Cost: a copy of V floats.
  Result<void> set_values(std::span<const float> values);
  /// One place in the colours a vertex, -1 where there is none (Paint::kRegions), and its margin
  /// (region_margins()); empty: no regions.
  Result<void> set_regions(std::span<const std::int32_t> regions, std::span<const float> margins);
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
                      const PanelDraw* panels = nullptr, SceneUse use = SceneUse::kOnce);

  /// Whether the next frames draw a surface of many faces by one of few that looks like it, where
  /// the device has memory for it. Cost: the first time after the surface has changed, that of
  /// coarse_surface().
  void set_coarse(bool coarse);
  /// 1 or 4, from the next frame on; what is made for either is kept, so that turning is free.
  void set_samples(int samples);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Draws a picture of scene.camera.extent pixels into memory, in tiles where it is larger than
/// `largest_tile` (0: a size that suits) or than the device can draw at once. Errors: kBadInput (a
/// size that is not
/// between 1 and 16384), the renderer's.
Result<Image> draw_picture(const Device& device, Renderer& renderer, const Scene& scene,
                           const Overlay& overlay = {}, int largest_tile = 0);

}  // namespace geotherm::engine
