// SPDX-License-Identifier: MIT
#pragma once

#include "ui/action.h"

namespace geotherm::ui {

struct Frame;

void draw_menu_bar(Frame& frame);

/// An entry with the action's keys and check mark.
void draw_menu_action(Frame& frame, const char* label, Action action);

}  // namespace geotherm::ui
