// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// A field for any command in its text form; arrows up and down bring back what was typed before.
void draw_command_line(Frame& frame);

/// What the line about a wrong command needs above the field.
float command_error_height(Frame& frame);

}  // namespace geotherm::ui
