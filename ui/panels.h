// SPDX-License-Identifier: MIT
#pragma once

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

/// What the log window holds.
void draw_log_panel(Frame& frame);

/// A field for any command in its text form; arrows up and down bring back what was typed before.
void draw_command_line(Frame& frame);

/// What the line about a wrong command needs above the field.
float command_error_height(Frame& frame);

}  // namespace geotherm::ui
