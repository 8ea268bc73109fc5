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

/// Two fields; an empty one is left to the data.
void draw_range(Frame& frame, const app::Setting& setting) {
  const app::PictureSettings& picture = frame.state().picture;
  const auto text = [](const std::optional<double>& value) {
    return value ? exact(*value) : std::string();
  };
  std::string low = text(picture.range_min), high = text(picture.range_max);
  draw_setting_label(frame, setting);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth((ImGui::GetContentRegionAvail().x - gap) / 2);
  const auto new_low = draw_field(frame, "range min", low, "auto");
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const auto new_high = draw_field(frame, "range max", high, "auto");
  if (!new_low && !new_high) return;
  low = new_low.value_or(low);
  high = new_high.value_or(high);
  frame.set(setting.name, low.empty() && high.empty() ? "auto" : low + ":" + high);
}

void draw_spacing(Frame& frame, const app::Setting& setting) {
  const auto& spacing = frame.state().picture.line_spacing;
  draw_setting_label(frame, setting);
  if (const auto typed = draw_field(frame, setting.name, spacing ? exact(*spacing) : "", "auto")) {
    frame.set(setting.name, typed->empty() ? "auto" : *typed);
  }
}

/// A slider from 0 to 1 with a field beside it. What it is moved to or what is typed.
std::optional<std::string> draw_share_row(Frame& frame, std::string_view name, double current) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  constexpr double kLow = 0, kHigh = 1;
  std::optional<std::string> chosen;
  double share = current;
  ImGui::SetNextItemWidth(width * 0.6F - gap);
  if (ImGui::SliderScalar(("##slider " + std::string(name)).c_str(), ImGuiDataType_Double, &share,
                          &kLow, &kHigh, "", ImGuiSliderFlags_NoInput)) {
    const std::string text = app::significant(share, 3);
    if (app::number_in<double>(text) != current) chosen = text;
  }
  frame.mark(std::string(name) + " slider");
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (const auto typed = draw_field(frame, name, exact(current))) chosen = typed;
  return chosen;
}

void draw_slice_at(Frame& frame, const app::Setting& setting) {
  const app::PictureSettings& picture = frame.state().picture;
  draw_setting_label(frame, setting);
  ImGui::BeginDisabled(!picture.slice.has_value());
  const auto chosen = draw_share_row(frame, setting.name, picture.slice_at);
  ImGui::EndDisabled();
  if (chosen) frame.set(setting.name, *chosen);
}

void draw_peel(Frame& frame, const app::Setting& setting) {
  draw_setting_label(frame, setting);
  const app::Peel& peel = frame.state().picture.peel;
  const std::string side = geotherm::to_text(peel.side);
  const auto sides = all_names<app::PeelSide>();
  if (const auto chosen = draw_choice(frame, setting.name, side, sides)) {
    frame.set(setting.name, *chosen == "off" ? *chosen : *chosen + ":" + exact(peel.share));
  }
  if (peel.side == app::PeelSide::kOff) return;
  draw_label(frame, "peel at", setting.help);
  if (const auto share = draw_share_row(frame, "peel-at", peel.share)) {
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
  std::string right = app::significant(camera.pan_right, 4);
  std::string up = app::significant(camera.pan_up, 4);
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth((ImGui::GetContentRegionAvail().x - gap) / 2);
  const auto new_right = draw_field(frame, "pan right", right);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const auto new_up = draw_field(frame, "pan up", up);
  if (!new_right && !new_up) return;
  frame.set(setting.name, new_right.value_or(right) + ":" + new_up.value_or(up));
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
  if (draw_toggle(frame, {"rotate", "Rotate", frame.state().rotating, true}, width)) {
    perform(frame, Action::kRotate);
  }
  draw_tip(frame, "Turns the model (p).");
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
