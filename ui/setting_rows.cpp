// SPDX-License-Identifier: MIT
#include "ui/setting_rows.h"

#include "app/explore/settings.h"
#include "ui/widgets.h"

namespace geotherm::ui {
namespace {

std::string tip_of(const app::Setting& setting, std::string_view more) {
  std::string tip(setting.help);
  if (!more.empty()) (tip += "\n") += more;
  return tip;
}

}  // namespace

std::string setting_text(const Frame& frame, std::string_view name) {
  const app::Setting* setting = app::find_setting(name);
  return setting ? setting->get(frame.state()) : std::string();
}

void draw_setting_choice(Frame& frame, std::string_view name, std::string_view label,
                         std::string_view tip) {
  const app::Setting* setting = app::find_setting(name);
  if (!setting) return;
  draw_label(frame, label, tip_of(*setting, tip));
  const auto values = setting->values();
  const auto chosen = draw_choice(frame, name, setting->get(frame.state()), values);
  if (chosen) frame.set(name, *chosen);
}

void draw_setting_field(Frame& frame, std::string_view name, std::string_view label,
                        const char* hint, std::string_view tip) {
  const app::Setting* setting = app::find_setting(name);
  if (!setting) return;
  draw_label(frame, label, tip_of(*setting, tip));
  const auto typed = draw_field(frame, name, setting->get(frame.state()), hint);
  if (typed && !typed->empty()) frame.set(name, *typed);
}

void draw_setting_flag(Frame& frame, std::string_view name, const char* label) {
  const app::Setting* setting = app::find_setting(name);
  if (!setting) return;
  bool on = setting->get(frame.state()) == "on";
  if (draw_checkbox(frame, name, label, on)) frame.set(name, on ? "on" : "off");
  draw_tip(frame, setting->help);
}

std::string name_part(const std::string& text) { return text.substr(0, text.find(':')); }

std::string value_part(const std::string& text) {
  const std::size_t colon = text.find(':');
  return colon == std::string::npos ? std::string() : text.substr(colon + 1);
}

}  // namespace geotherm::ui
