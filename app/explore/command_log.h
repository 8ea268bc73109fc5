// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/explore/command.h"

namespace geotherm::app {

/// The commands since the start, as a script that leads to the same state. Of drags only the ends
/// are kept: moves of the camera become one `camera place`, a dragged source its last place, a
/// slider its last value.
class CommandLog {
 public:
  /// `after`: the state that the command led to. True when it took the place of the last one.
  bool add(const Command& command, const ViewerState& after);
  /// The last `open` did not open anything: it becomes a comment, so that the log can be replayed.
  void fail_last_open();
  /// A line that is no command.
  void add_comment(const std::string& text);

  std::string last_line() const;  ///< empty: none
  std::string script() const;

 private:
  struct Line {
    std::optional<Command> command;
    std::string comment;
  };
  std::vector<Line> lines_;
};

/// Whether a command goes on with what the one before it began, as of a drag: both are undone
/// together.
bool continues(const Command& before, const Command& now);

}  // namespace geotherm::app
