// SPDX-License-Identifier: MIT
#pragma once

#include "ui/action.h"

namespace geotherm::ui {

struct Frame;

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
