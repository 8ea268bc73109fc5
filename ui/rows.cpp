// SPDX-License-Identifier: MIT
#include "ui/panels.h"

#include <imgui.h>
#include <algorithm>
#include <cmath>

#include "app/session/settings.h"
#include "app/text/text.h"
#include "ui/action.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

/// The phrase, what the values mean, and more.
std::string tip_of(const app::Setting& setting, std::string_view more) {
  std::string tip(setting.help);
  for (const std::string_view part : {setting.detail, more}) {
    if (!part.empty()) (tip += "\n") += part;
  }
  return tip;
}

std::string label_of(const app::Setting& setting) {
  std::string label(setting.name);
  std::ranges::replace(label, '-', ' ');
  return label;
}

void draw_switch(Frame& frame, const app::Setting& setting) {
  bool on = setting.get(frame.state()) == "on";
  if (draw_checkbox(frame, setting.name, label_of(setting).c_str(), on)) {
    frame.set(setting.name, on ? "on" : "off");
  }
  draw_tip(frame, tip_of(setting, {}));
}

/// The setting, where A and B have their own and B is shown; null: what is set is what is seen.
const app::Setting* setting_of_a(const Frame& frame, std::string_view name) {
  if (frame.state().shown != app::Shown::kB) return nullptr;
  const app::Setting* const setting = app::find_setting(name);
  return setting != nullptr && setting->of_method() ? setting : nullptr;
}

}  // namespace

void Frame::set(std::string_view name, std::string value) {
  const app::Setting* const of_a = setting_of_a(*this, name);
  app::ViewerState changed = state();
  const bool shows_a = of_a != nullptr && of_a->set(changed, value);
  send(app::command::Set{std::string(name), std::move(value)});
  if (shows_a) send(app::command::Show{app::Shown::kA});
}

std::string setting_text(const Frame& frame, std::string_view name) {
  const app::Setting* setting = app::find_setting(name);
  return setting ? setting->get(frame.state()) : std::string();
}

void draw_setting_label(Frame& frame, const app::Setting& setting, std::string_view more) {
  draw_label(frame, label_of(setting), tip_of(setting, more));
}

void draw_setting(Frame& frame, const app::Setting& setting, std::string_view more) {
  if (setting.kind == app::SettingKind::kSwitch) return draw_switch(frame, setting);
  draw_setting_label(frame, setting, more);
  const std::string text = setting.get(frame.state());
  if (setting.values != nullptr && setting.forms.empty()) {
    if (const auto chosen = draw_choice(frame, setting.name, text, setting.values())) {
      frame.set(setting.name, *chosen);
    }
    return;
  }
  const auto typed = draw_field(frame, setting.name, text);
  if (typed && !typed->empty()) frame.set(setting.name, *typed);
}

bool draw_remedies(Frame& frame, std::span<const SettingHint> settings, bool of_shown) {
  bool taken = false;
  for (const SettingHint& setting : settings) {
    for (const std::string& value : setting.values) {
      const std::string change = setting.name + ' ' + value;
      if (!draw_button(frame, change, change.c_str())) continue;
      if (of_shown && setting_of_a(frame, setting.name)) perform(frame, Action::kSwap);
      frame.set(setting.name, value);
      taken = true;
    }
  }
  return taken;
}

void draw_advice(Frame& frame, const std::string& text, const Hint& hint, const ImVec4& colour) {
  draw_note(text, colour);
  // Sections of one bar may say the same.
  ImGui::PushID(frame.section.c_str());
  ImGui::PushID(text.c_str());
  draw_remedies(frame, settings_of(hint));
  ImGui::PopID();
  ImGui::PopID();
}

std::string name_part(const std::string& text) { return text.substr(0, text.find(':')); }

std::string value_part(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? std::string() : text.substr(colon + 1);
}

void draw_progress(Frame& frame, double share, float height) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float round = height / 2;
  list->AddRectFilled(low, {low.x + width, low.y + height}, packed(frame.colours().frame), round);
  float begin = 0, end = static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (share < 0) {  // a piece that runs to and fro
    begin = 0.375F + 0.375F * static_cast<float>(std::sin(ImGui::GetTime() * 3));
    end = begin + 0.25F;
  }
  list->AddRectFilled({low.x + begin * width, low.y}, {low.x + end * width, low.y + height},
                      packed(frame.colours().accent), round);
  ImGui::Dummy({width, height});
}

void draw_work_row(Frame& frame) {
  // What comes and goes with each answer of a drag says nothing.
  const bool moves =
      frame.ui.input.is_dragging() || frame.ui.scrubs || frame.state().timeline.playing;
  const app::SessionWork work = frame.session.work();
  const Palette& p = frame.colours();
  const float bar = frame.px(5);
  if (moves || !work.busy) {
    // As high as while work goes on, so that the rows below stay where they are.
    const bool stale = !moves && frame.session.stale();
    const bool of_a = frame.state().shown == app::Shown::kB;
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, stale || of_a ? p.warning : p.dim);
    ImGui::TextUnformatted(moves            ? "live"
                           : stale          ? "stale: of other settings"
                           : of_a           ? "B is shown, these are A's"
                           : frame.answer() ? "up to date"
                                            : "nothing to do yet");
    ImGui::PopStyleColor();
    ImGui::Dummy({0, bar});
    return;
  }
  std::string text = work.stage.empty() ? "working" : work.stage;
  if (work.share >= 0) text += "  " + app::fixed(100 * work.share, 0) + " %";
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, p.accent);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  const float width = frame.px(70);
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
  if (draw_button(frame, "cancel", "Cancel", true, width)) frame.out.cancel = true;
  draw_progress(frame, work.share, bar);
}

}  // namespace geotherm::ui
