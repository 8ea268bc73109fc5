// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// Begins a dialog in the middle of the window, over all else; width and height at scale 1, less
/// where the window is smaller. True: it is open, and ImGui::EndPopup() must follow.
bool begin_dialog(Frame& frame, const char* id, const char* title, float width, float height);

bool is_escape_pressed();
bool is_enter_pressed();

/// The list of keys, and what the program is.
void draw_keys_dialog(Frame& frame);
void draw_about_dialog(Frame& frame);

}  // namespace geotherm::ui
