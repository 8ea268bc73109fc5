// SPDX-License-Identifier: MIT
#include <imgui.h>

#include "app/picture/picture_text.h"
#include "app/text.h"
#include "ui/action.h"
#include "ui/number.h"
#include "ui/panels.h"
#include "ui/setting_rows.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

void draw_colour_map(Frame& frame) {
  draw_label(frame, "colours", "Colours of the distances.");
  const auto maps = frame.canvas.colour_maps();
  const auto chosen = draw_choice(frame, "colour-map", frame.state().picture.colour_map, maps);
  if (chosen) frame.set("colour-map", *chosen);
}

/// Two fields; an empty one is left to the data.
void draw_range(Frame& frame) {
  const app::PictureSettings& picture = frame.state().picture;
  const auto text = [](const std::optional<double>& value) {
    return value ? exact(*value) : std::string();
  };
  std::string low = text(picture.range_min), high = text(picture.range_max);
  draw_label(frame, "range",
             "Distances at both ends of the colour map, model units; empty: 0 and "
             "the largest.");
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth((ImGui::GetContentRegionAvail().x - gap) / 2);
  const auto new_low = draw_field(frame, "range min", low, "auto");
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const auto new_high = draw_field(frame, "range max", high, "auto");
  if (!new_low && !new_high) return;
  low = new_low.value_or(low);
  high = new_high.value_or(high);
  frame.set("range", low.empty() && high.empty() ? "auto" : low + ":" + high);
}

void draw_spacing(Frame& frame) {
  const auto& spacing = frame.state().picture.line_spacing;
  draw_label(frame, "contours",
             "Distance between isolines, model units; 0: none; empty: a round "
             "number that suits.");
  if (const auto typed = draw_field(frame, "spacing", spacing ? exact(*spacing) : "", "auto")) {
    frame.set("spacing", typed->empty() ? "auto" : *typed);
  }
}

void draw_flags(Frame& frame) {
  const float second = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x / 2;
  draw_setting_flag(frame, "reverse", "reverse");
  ImGui::SameLine(second);
  draw_setting_flag(frame, "bar", "colour bar");
  draw_setting_flag(frame, "caption", "caption");
  ImGui::SameLine(second);
  draw_setting_flag(frame, "markers", "markers");
}

/// A number of the camera, shown with few digits but changed only by typing.
void draw_camera_number(Frame& frame, const char* name, const char* label, double value,
                        const char* help) {
  draw_label(frame, label, help);
  const std::string shown = app::significant(value, 5);
  if (const auto typed = draw_field(frame, name, shown)) frame.set(name, *typed);
}

void draw_pan(Frame& frame) {
  const app::CameraSettings& camera = frame.state().picture.camera;
  draw_label(frame, "shift", "Right and up, in picture heights.");
  std::string right = app::significant(camera.pan_right, 4);
  std::string up = app::significant(camera.pan_up, 4);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth((ImGui::GetContentRegionAvail().x - gap) / 2);
  const auto new_right = draw_field(frame, "pan right", right);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const auto new_up = draw_field(frame, "pan up", up);
  if (!new_right && !new_up) return;
  frame.set("pan", new_right.value_or(right) + ":" + new_up.value_or(up));
}

void draw_camera(Frame& frame) {
  const app::CameraSettings& camera = frame.state().picture.camera;
  draw_heading(frame, "Camera");
  draw_setting_choice(frame, "projection", "projection");
  draw_setting_choice(frame, "fit", "fit",
                      "tight: as large as it can be from here; sphere: the same size from "
                      "everywhere.");
  draw_camera_number(frame, "azimuth", "azimuth", camera.azimuth,
                     "Degrees of the eye about the vertical axis.");
  draw_camera_number(frame, "elevation", "elevation", camera.elevation,
                     "Degrees of the eye, -90 to 90.");
  draw_camera_number(frame, "zoom", "zoom", camera.zoom, "1: as large as it fits.");
  draw_pan(frame);
  draw_setting_field(frame, "centre", "centre");
  const float width = button_width(3);
  if (draw_button(frame, "frame", "Frame", frame.model(), width)) perform(frame, Action::kFrame);
  draw_tip(frame, "The whole model in the middle; the direction stays (f).");
  ImGui::SameLine();
  if (draw_button(frame, "reset", "Reset", frame.model(), width)) {
    const app::CameraSettings start;
    frame.send(app::command::Frame{});
    frame.send(app::command::Place{start.azimuth, start.elevation, start.zoom, start.pan_right,
                                   start.pan_up});
  }
  draw_tip(frame, "The camera as it was when the program started.");
  ImGui::SameLine();
  if (draw_toggle(frame, {"rotate", "Rotate", frame.state().rotating, true}, width)) {
    perform(frame, Action::kRotate);
  }
  draw_tip(frame, "Turns the model (p).");
}

}  // namespace

void draw_view_panel(Frame& frame) {
  if (!draw_section(frame, "View", false)) return;
  draw_setting_choice(frame, "view", "view", "Keys 1 to 9, 0, g, t and n.");
  draw_colour_map(frame);
  draw_range(frame);
  draw_spacing(frame);
  draw_setting_choice(frame, "light", "light");
  draw_setting_choice(frame, "background", "background");
  draw_setting_choice(frame, "samples", "samples", "4: smooth edges; 1: faster.");
  draw_flags(frame);
  draw_camera(frame);
}

}  // namespace geotherm::ui
