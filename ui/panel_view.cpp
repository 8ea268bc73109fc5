// SPDX-License-Identifier: MIT
#include <imgui.h>

#include "app/picture/picture_text.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/frame.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

void draw_colour_map(Frame& frame, const app::Setting& setting) {
  draw_setting_label(frame, setting);
  const auto maps = frame.canvas.colour_maps();
  const auto chosen = draw_choice(frame, setting.name, frame.state().picture.colour_map, maps);
  if (chosen) frame.set(setting.name, *chosen);
}

/// Two fields side by side. What both hold, with a colon between, once one of them is typed into.
std::optional<std::string> draw_pair(Frame& frame, const char* first_key, const std::string& first,
                                     const char* second_key, const std::string& second,
                                     const char* hint = "") {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth((ImGui::GetContentRegionAvail().x - gap) / 2);
  const auto new_first = draw_field(frame, first_key, first, hint);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const auto new_second = draw_field(frame, second_key, second, hint);
  if (!new_first && !new_second) return std::nullopt;
  return new_first.value_or(first) + ":" + new_second.value_or(second);
}

/// An end that is empty is left to the data.
void draw_range(Frame& frame, const app::Setting& setting) {
  const app::PictureSettings& picture = frame.state().picture;
  const auto text = [](const std::optional<double>& value) {
    return value ? number_text(*value) : std::string();
  };
  draw_setting_label(frame, setting);
  const auto typed = draw_pair(frame, "range min", text(picture.range_min), "range max",
                               text(picture.range_max), "auto");
  if (typed) frame.set(setting.name, *typed == ":" ? "auto" : *typed);
}

void draw_spacing(Frame& frame, const app::Setting& setting) {
  const auto& spacing = frame.state().picture.line_spacing;
  draw_setting_label(frame, setting);
  if (const auto typed =
          draw_field(frame, setting.name, spacing ? number_text(*spacing) : "", "auto")) {
    frame.set(setting.name, typed->empty() ? "auto" : *typed);
  }
}

void draw_slice_at(Frame& frame, const app::Setting& setting) {
  const app::PictureSettings& picture = frame.state().picture;
  draw_setting_label(frame, setting);
  ImGui::BeginDisabled(!picture.slice.has_value());
  const auto chosen = draw_slider_row(frame, setting.name, picture.slice_at, 0, 1);
  ImGui::EndDisabled();
  if (chosen) frame.set(setting.name, *chosen);
}

void draw_peel(Frame& frame, const app::Setting& setting) {
  draw_setting_label(frame, setting);
  const app::Peel& peel = frame.state().picture.peel;
  const std::string side = geotherm::to_text(peel.side);
  const auto sides = all_names<app::PeelSide>();
  if (const auto chosen = draw_choice(frame, setting.name, side, sides)) {
    frame.set(setting.name, *chosen == "off" ? *chosen : *chosen + ":" + number_text(peel.share));
  }
  if (peel.side == app::PeelSide::kOff) return;
  draw_label(frame, "peel at", setting.help);
  if (const auto share = draw_slider_row(frame, "peel-at", peel.share, 0, 1)) {
    frame.set(setting.name, side + ":" + *share);
  }
}

/// The switches, two side by side.
void draw_switches(Frame& frame) {
  const float second = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x / 2;
  bool right = false;
  for (const app::Setting& setting : app::settings()) {
    const bool is_switch = setting.kind == app::SettingKind::kSwitch;
    if (setting.group != app::SettingGroup::kPicture || !is_switch) continue;
    if (right) ImGui::SameLine(second);
    draw_setting(frame, setting);
    right = !right;
  }
}

/// A number of the camera, shown with few digits but changed only by typing.
void draw_camera_number(Frame& frame, const app::Setting& setting) {
  draw_setting_label(frame, setting);
  const double value = app::number_in<double>(setting.get(frame.state())).value_or(0);
  if (const auto typed = draw_field(frame, setting.name, app::significant(value, 5))) {
    frame.set(setting.name, *typed);
  }
}

void draw_pan(Frame& frame, const app::Setting& setting) {
  const app::CameraSettings& camera = frame.state().picture.camera;
  draw_setting_label(frame, setting);
  const auto typed = draw_pair(frame, "pan right", app::significant(camera.pan_right, 4), "pan up",
                               app::significant(camera.pan_up, 4));
  if (typed) frame.set(setting.name, *typed);
}

void draw_camera(Frame& frame) {
  for (const app::Setting& setting : app::settings()) {
    if (setting.group != app::SettingGroup::kCamera) continue;
    if (setting.name == "pan") {
      draw_pan(frame, setting);
    } else if (setting.kind == app::SettingKind::kNumber) {
      draw_camera_number(frame, setting);
    } else {
      draw_setting(frame, setting);
    }
  }
  const float width = button_width(3);
  if (draw_button(frame, "frame", "Frame", frame.model(), width)) perform(frame, Action::kFrame);
  draw_tip(frame, "The whole model, as large as there is room for; the direction stays (f).");
  ImGui::SameLine();
  if (draw_button(frame, "reset", "Reset", frame.model(), width)) {
    const app::CameraSettings start;
    frame.send(app::command::Frame{});
    frame.send(app::command::Place{start.azimuth, start.elevation, start.zoom, start.pan_right,
                                   start.pan_up});
  }
  draw_tip(frame, "The camera as it was when the program started.");
  ImGui::SameLine();
  draw_action(frame, "rotate", "Rotate", Action::kRotate, "Turns the model (p).", width);
}

}  // namespace

namespace {

void draw_picture_rows(Frame& frame, bool usual) {
  for (const app::Setting& setting : app::settings()) {
    const bool is_switch = setting.kind == app::SettingKind::kSwitch;
    if (setting.group != app::SettingGroup::kPicture || is_switch) continue;
    if (setting.name == "size") continue;  // in the dialog that saves a picture
    if (setting.usual != usual) continue;
    if (setting.name == "colour-map") {
      draw_colour_map(frame, setting);
    } else if (setting.name == "range") {
      draw_range(frame, setting);
    } else if (setting.name == "spacing") {
      draw_spacing(frame, setting);
    } else if (setting.name == "slice-at") {
      draw_slice_at(frame, setting);
    } else if (setting.name == "peel") {
      draw_peel(frame, setting);
    } else {
      draw_setting(frame, setting, setting.name == "view" ? "Keys 1 to 9, 0, g, t and n." : "");
    }
  }
}

}  // namespace

void draw_view_panel(Frame& frame) {
  if (!draw_section(frame, "View")) return;
  draw_picture_rows(frame, true);
  if (draw_more(frame, "More of the view")) {
    draw_picture_rows(frame, false);
    draw_switches(frame);
  }
  if (draw_more(frame, "Camera")) draw_camera(frame);
  if (!draw_more(frame, "Figure")) return;
  for (const app::Setting& setting : app::settings()) {
    if (setting.group == app::SettingGroup::kFigure) draw_setting(frame, setting);
  }
}

}  // namespace geotherm::ui
