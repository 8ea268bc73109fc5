// SPDX-License-Identifier: MIT
#pragma once

#include "app/session/explored.h"
#include "app/window/scene_screen.h"
#include "engine/renderer.h"
#include "ui/interface.h"

namespace geotherm::app {

/// What of the picture the panels ask for: the surface under the pointer, where points are seen.
/// `pixels_per_point`: pixels of the window per unit of ImGui.
class ViewCanvas final : public ui::Canvas {
 public:
  ViewCanvas(const SceneScreen& screen, const Explored& explored, double fps,
             float pixels_per_point);

  std::optional<SurfacePoint> surface_at(float x, float y) const override;
  std::optional<ui::InsidePoint> inside_at(float x, float y) const override;
  std::optional<std::array<float, 2>> place_of(const Vec3& point) const override;
  std::array<float, 2> lens_centre() const override;
  float title_height() const override;
  std::optional<app::command::Place> tight() const override;
  double fps() const override { return fps_; }
  std::vector<std::string> colour_maps() const override;
  std::string device() const override;

 private:
  struct Ray {
    Vec3 origin, direction;  ///< scene space
  };
  Ray ray_at(float x, float y) const;
  Vec3 in_model(const Vec3& scene) const;
  glm::dvec2 in_picture(float x, float y) const;
  std::array<float, 2> in_window(const glm::dvec2& pixel) const;

  const SceneScreen& screen_;
  const Explored& explored_;
  double fps_;
  double pixels_per_point_;
};

/// The image of all letters that the current ImGui context has loaded. `version` counts them.
engine::PanelFont panel_font(std::uint64_t version);

/// The panels of the last ImGui::Render(), in pixels of the target.
engine::PanelDraw panel_draw();

}  // namespace geotherm::app
