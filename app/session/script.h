// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/session/command.h"
#include "app/session/outputs.h"
#include "geotherm/error.h"

// What commands may write. Scripts come from others: none may reach a file that is not its own.
namespace geotherm::app {

/// The extension of session files, which are scripts of commands.
inline constexpr std::string_view kSessionExtension = ".geotherm";

/// Whether a file has it, whatever the case.
bool is_session(const std::string& path);

/// Second line of what the program writes. A shell that is given the file takes all that follows
/// for a text that it does not look into; geotherm skips the line.
inline constexpr const char* kInertLine = ": <<'commands of geotherm'";

/// The commands of a file. Errors: kBadFile: it cannot be read, and those of parse_script().
Result<std::vector<ScriptLine>> read_script(const std::string& path);

/// The files that a script asks to write, through the scripts that it runs as well, each once and
/// in their order. What cannot be read counts as empty: to run it is the error.
std::vector<std::string> files_written_by(const std::string& script);

/// The commands since the start, as a script that leads to the same state. Of drags only the ends
/// are kept: moves of the camera become one `camera place`, a dragged source its last place, a
/// slider its last value, frames that were played the last of them.
class CommandLog {
 public:
  /// `after`: the state that the command led to. True when it took the place of the last one.
  bool add(const Command& command, const ViewerState& after);
  /// The last `open` did not open anything: it becomes a comment, so that the log can be replayed.
  void fail_last_open();
  /// The same of the last `frame`; `all`: of the last `sequence`, and what was shown of it.
  void fail_last_frame(bool all);
  /// The last line of a command that failed only after it was added goes.
  void drop_last(const Command& command);
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

/// For what a session writes: the files that it shows are refused.
Outputs outputs_beside(const ViewerState& state);

/// The file that a command writes; null: it writes none.
const std::string* saved_path(const Command& command);

/// Whether the file has an extension of the command's kind, and no part of its path is hidden; also
/// where links lead that are in it. Precondition: saved_path(command). Errors: kBadInput,
/// kNotAvailable.
Result<void> check_saved_name(const Command& command);

/// Whether nothing is at the command's path, so that a script that has not written there in this
/// run may. Precondition: saved_path(command). Errors: kBadInput.
Result<void> check_replaced_by_script(const Command& command);

}  // namespace geotherm::app
