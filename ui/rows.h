// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "app/session/settings.h"
#include "ui/frame.h"

// Rows of panels that show a setting (app/session/settings.h) and change it by a command.
namespace geotherm::ui {

/// The setting's text; empty where there is no such setting.
std::string setting_text(const Frame& frame, std::string_view name);

/// The name with its help as a tip. `more`: further sentences of the tip.
void draw_setting_label(Frame& frame, const app::Setting& setting, std::string_view more = {});

/// The whole row: a check box, a list of the values, or a field.
void draw_setting(Frame& frame, const app::Setting& setting, std::string_view more = {});

/// What stands before the colon of NAME:VALUE, and what stands after it.
std::string name_part(const std::string& text);
std::string value_part(const std::string& text);

struct Frame;

/// What the background works at, with a bar and a button to stop it; or whether what is shown
/// belongs to the settings.
void draw_work_row(Frame& frame);

/// A bar across the row, `share` from 0 to 1, negative: unknown.
void draw_progress(Frame& frame, double share, float height);

}  // namespace geotherm::ui
