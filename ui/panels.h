// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/session/check.h"
#include "app/session/settings.h"
#include "ui/action.h"
#include "ui/frame.h"

// Panels and bars, and what they are made of: rows that show a setting (app/session/settings.h) and
// change it by a command, and plots.
namespace geotherm::ui {

struct Frame;

// Sections of the left side bar.
void draw_model_panel(Frame& frame);
void draw_sources_panel(Frame& frame);
void draw_solver_panel(Frame& frame);
void draw_ab_panel(Frame& frame);
void draw_view_panel(Frame& frame);

// Sections of the right side bar.
void draw_timing_panel(Frame& frame);
void draw_quality_panel(Frame& frame);
void draw_error_panel(Frame& frame);
void draw_point_panel(Frame& frame);
void draw_compare_panel(Frame& frame);
inline constexpr const char* kErrorSection = "Exact error";
inline constexpr const char* kCompareSection = "Compare backends";

/// What the log window holds.
void draw_log_panel(Frame& frame);

/// A field for any command in its text form; arrows up and down bring back what was typed before.
void draw_command_line(Frame& frame);

/// What the lines about a wrong command need above the field, pixels.
float command_error_height(Frame& frame);

/// The setting's text; empty where there is no such setting.
std::string setting_text(const Frame& frame, std::string_view name);

/// The name with its help as a tip. `more`: further sentences of the tip.
void draw_setting_label(Frame& frame, const app::Setting& setting, std::string_view more = {});

/// The whole row: a check box, a list of the values, or a field.
void draw_setting(Frame& frame, const app::Setting& setting, std::string_view more = {});

/// A button for each value of the settings that may help. `of_shown`: they help the answer that is
/// shown, so B becomes A first where that is B. True: one was taken.
bool draw_remedies(Frame& frame, std::span<const SettingHint> settings, bool of_shown = true);

/// A sentence with what helps, and the buttons of that.
void draw_advice(Frame& frame, const std::string& text, const Hint& hint, const ImVec4& colour);

/// What stands before the colon of NAME:VALUE, and what stands after it.
std::string name_part(const std::string& text);
std::string value_part(const std::string& text);

/// What the background works at, with a bar and a button to stop it; or whether what is shown
/// belongs to the settings.
void draw_work_row(Frame& frame);

/// A bar across the row, `share` from 0 to 1, negative: unknown.
void draw_progress(Frame& frame, double share, float height);

/// How many vertices have which signed error, with 0 marked; shows a part's figures on hover.
void draw_error_plot(Frame& frame, const ErrorHistogram& histogram);

/// The error over the time factor, with the present one marked; both axes logarithmic. What a
/// click on it means: the factor of the nearest point.
std::optional<double> draw_study_plot(Frame& frame, const app::SessionStudy& study, double factor);

/// The last queries as columns, the newest on the right: diffuse, gradient, poisson on each other.
void draw_query_plot(Frame& frame);

void draw_menu_bar(Frame& frame);

/// An entry with the action's keys and check mark.
void draw_menu_action(Frame& frame, const char* label, Action action);

/// Both side bars and the log, with the edges that resize them.
void draw_side_bars(Frame& frame);

/// What is shown, what goes on, and how fast, along the lower edge.
void draw_status_bar(Frame& frame);

/// A list to choose a bundled model from.
void draw_bundled_list(Frame& frame, float width);

}  // namespace geotherm::ui
