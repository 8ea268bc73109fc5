// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "ui/frame.h"

// Rows of panels that show a setting (app/explore/settings.h) and change it by a command.
namespace geotherm::ui {

/// The setting's text; empty where there is no such setting.
std::string setting_text(const Frame& frame, std::string_view name);

/// A list of its values. `tip`: beside the setting's own line of help.
void draw_setting_choice(Frame& frame, std::string_view name, std::string_view label,
                         std::string_view tip = {});

/// A field for its text.
void draw_setting_field(Frame& frame, std::string_view name, std::string_view label,
                        const char* hint = "", std::string_view tip = {});

/// A check box for `on` and `off`.
void draw_setting_flag(Frame& frame, std::string_view name, const char* label);

/// What stands before the colon of NAME:VALUE, and what stands after it.
std::string name_part(const std::string& text);
std::string value_part(const std::string& text);

}  // namespace geotherm::ui
