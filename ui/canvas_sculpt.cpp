// SPDX-License-Identifier: MIT
// Sculpting with the mouse: the stroke, the ring under the pointer, and the bar with its tools.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/text/text.h"
#include "ui/action.h"
#include "ui/canvas.h"
#include "ui/frame.h"
#include "ui/source_edit.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

using app::SculptTool;

constexpr float kSpacing = 0.25F;        ///< between touches, in radii as they are seen
constexpr float kMinSpacing = 2;         ///< pixels at scale 1
constexpr std::size_t kMaxTouches = 24;  ///< of one frame, where the pointer has leapt
constexpr float kMinRadius = 0.005F, kMaxRadius = 0.3F, kMinStrength = 0.01F;
constexpr int kDigits = 4;  ///< of a radius: more is not seen

/// Model units. Precondition: the model is described.
double radius_of(const Frame& frame) {
  const MeshReport& mesh = *frame.mesh();
  const double size = (mesh.box_max - mesh.box_min).norm();
  const auto text = app::significant(double{frame.ui.sculpt.radius} * size, kDigits);
  return app::number_in<double>(text).value_or(size);
}

std::optional<app::FacePoint> face_point_at(const Frame& frame, float x, float y) {
  if (!frame.mesh()) return std::nullopt;
  const auto point = frame.canvas.surface_at(x, y);
  const bool fits = point && !point->is_vertex() && point->face < frame.mesh()->faces;
  return fits ? std::optional(short_point(*point)) : std::nullopt;
}

/// Pixels that a radius about a point of the surface covers: three lengths at right angles, seen
/// from anywhere, have squares that sum to twice the circle's.
float seen_radius(const Frame& frame, const app::FacePoint& point, double radius) {
  const Vec3 middle =
      position_at(*frame.model()->model.mesh, SurfacePoint::in_face(point.face, point.weights));
  const auto seen = frame.canvas.place_of(middle);
  float sum = 0;
  for (int k = 0; k < 3 && seen; ++k) {
    const auto end = frame.canvas.place_of(middle + radius * Vec3::Unit(k));
    if (!end) continue;
    const float right = (*end)[0] - (*seen)[0], down = (*end)[1] - (*seen)[1];
    sum += right * right + down * down;
  }
  return std::sqrt(sum / 2);
}

SculptTool other_way(SculptTool tool) {
  if (tool == SculptTool::kPull) return SculptTool::kPush;
  return tool == SculptTool::kPush ? SculptTool::kPull : tool;
}

}  // namespace

std::optional<SculptTool> sculpt_tool(MouseAction action, SculptTool chosen) {
  switch (action) {
    case MouseAction::kSculpt:
      return chosen;
    case MouseAction::kSculptBack:
      return other_way(chosen);
    case MouseAction::kSculptSmooth:
      return SculptTool::kSmooth;
    default:
      return std::nullopt;
  }
}

bool SculptStroke::begin(Frame& frame, SculptTool tool, float x, float y) {
  if (!frame.model() || frame.model()->model.space) return false;
  const auto point = face_point_at(frame, x, y);
  if (!point) return false;
  const double radius = radius_of(frame);
  x_ = x;
  y_ = y;
  step_ = std::max(frame.px(kMinSpacing), kSpacing * seen_radius(frame, *point, radius));
  const double strength = *app::number_in<double>(number_text(frame.ui.sculpt.strength));
  frame.send(app::command::Sculpt{{tool, radius, strength, {*point}}});
  return true;
}

void SculptStroke::go_on(Frame& frame, float x, float y) {
  if (!frame.model()) return;
  app::command::ExtendStroke more;
  for (float left = std::hypot(x - x_, y - y_); left >= step_; left -= step_) {
    if (more.points.size() == kMaxTouches) {
      x_ = x;
      y_ = y;
      break;
    }
    x_ += (x - x_) * step_ / left;
    y_ += (y - y_) * step_ / left;
    if (const auto point = face_point_at(frame, x_, y_)) more.points.push_back(*point);
  }
  if (!more.points.empty()) frame.send(std::move(more));
}

float sculpt_ring(const Frame& frame, const std::optional<SurfacePoint>& hovered) {
  if (!hovered || hovered->is_vertex() || !frame.mesh()) return 0;
  return seen_radius(frame, {hovered->face, hovered->weights}, radius_of(frame));
}

namespace {

/// A slider with its label in front; true when it was moved.
void draw_slider(Frame& frame, const char* label, float& value, float low, float high,
                 const char* tip) {
  ImGui::SameLine(0, frame.px(12));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(frame.px(90));
  const std::string id = std::string("##") + label;
  float moved = value;
  if (ImGui::SliderFloat(id.c_str(), &moved, low, high, "%.3g",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    value = *app::number_in<float>(app::significant(moved, 3));
  }
  frame.mark(label);
  draw_tip(frame, tip);
}

}  // namespace

void draw_sculpt_bar(Frame& frame) {
  const Rect& canvas = frame.ui.places.canvas;
  if (frame.ui.input.tool != Tool::kSculpt || !frame.model() || canvas.width < frame.px(200))
    return;
  frame.section = "Sculpt";
  begin_floating(frame, "##sculpt", {canvas.x + canvas.width / 2, canvas.y + frame.px(8)},
                 {0.5F, 0});
  SculptForm& form = frame.ui.sculpt;
  constexpr const char* kTips[] = {"Out of the surface; with Ctrl into it.",
                                   "Into the surface; with Ctrl out of it.",
                                   "Evens the surface out; so does Shift with the others."};
  for (const auto& [tool, name] : named_values(SculptTool{}).all) {
    if (tool != SculptTool::kPull) ImGui::SameLine();
    const std::string label(name);
    if (draw_toggle(frame, {name, label.c_str(), form.tool == tool, true}, frame.px(64))) {
      form.tool = tool;
    }
    draw_tip(frame, kTips[static_cast<std::size_t>(tool)]);
  }
  draw_slider(frame, "radius", form.radius, kMinRadius, kMaxRadius,
              "Of what a touch moves, as a share of the model's size.");
  draw_slider(frame, "strength", form.strength, kMinStrength, 1,
              "How far a touch moves the middle, in radii; smoothing: towards the mean.");
  ImGui::SameLine(0, frame.px(12));
  draw_action(frame, "undo", "Undo", Action::kUndo, "Takes the last stroke back (Ctrl+Z).");
  ImGui::SameLine();
  if (draw_button(frame, "close", "\u00d7")) perform(frame, Action::kSculpt);
  draw_tip(frame, "Ends sculpting (s, Esc).");
  ImGui::End();
}

}  // namespace geotherm::ui
