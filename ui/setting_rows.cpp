// SPDX-License-Identifier: MIT
#include "ui/setting_rows.h"

#include <algorithm>

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

}  // namespace

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

std::string name_part(const std::string& text) { return text.substr(0, text.find(':')); }

std::string value_part(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? std::string() : text.substr(colon + 1);
}

}  // namespace geotherm::ui
