// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/command.h"

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

/// Asks before a command of the user replaces a file, and before a script writes any. One question
/// at a time, over all else.
class WriteQuestion {
 public:
  /// Sends the command, at once or when the user agrees.
  void send(Frame& frame, app::Command command);
  void draw(Frame& frame);

 private:
  std::optional<app::Command> command_;  ///< waits for the answer
  std::string title_, text_;
  const char* verb_ = "";           ///< on the button that agrees
  std::vector<std::string> files_;  ///< one line each
  bool asked_ = false;
};

}  // namespace geotherm::ui
