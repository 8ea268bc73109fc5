// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/explore/command.h"

namespace geotherm::ui {

struct Frame;

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
