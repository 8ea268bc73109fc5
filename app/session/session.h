// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/session/command.h"
#include "app/session/compare.h"
#include "app/session/explored.h"

namespace geotherm::app {

/// A line of the log panel.
struct LogLine {
  enum class Kind { kCommand, kNote, kWarning, kError };
  Kind kind = Kind::kNote;
  std::string text;
  Hint hint = {};            ///< of a warning or an error: what to do
  bool has_written = false;  ///< a note of a file that a user has asked for
};

/// Times of one query, for the plot.
struct QueryRecord {
  std::string backend;
  QueryTiming timing;
};

/// What runs in the background.
struct SessionWork {
  bool busy = false;
  std::string stage;  ///< "reading", "factorize", ...
  double share = -1;  ///< 0 to 1; negative: unknown
};

/// The last comparison of backends.
struct SessionCompare {
  bool running = false;
  std::vector<CompareRow> rows;
  std::string reference;
};

/// The mean error over the time factor, of the sources and settings that it began with.
struct SessionStudy {
  bool running = false;
  struct Point {
    double factor = 1, mean_error = 0;  ///< the latter relative
  };
  std::vector<Point> points = {};  ///< by factor, as far as there are any yet
  std::string failure = {};        ///< why there are no more; empty: nothing went wrong
  bool cancelled = false;          ///< the user stopped it; study() begins again
};

/// What a session is given to work with.
struct SessionHooks {
  /// Does the work on threads of its own and calls this, from any thread, when update() has
  /// something to take. Empty: submit() does the work itself and returns when it is done.
  std::function<void()> wake;
  Progress progress;  ///< watches the work that submit() does itself
  /// Writes a picture of the state and what is explored. Empty: pictures cannot be saved.
  std::function<Result<void>(const command::SavePicture&, const class Session&)> save_picture;
  std::vector<std::string> colour_maps;  ///< empty: any name will do
  /// The picture's settings with the size and the letters that it is seen with, which saved
  /// sessions and logs end with. Empty: nobody sees it.
  std::function<PictureSettings()> seen;
  /// Commands that write files are skipped, and said to be: a log from elsewhere is replayed.
  bool writes_files = true;
};

/// The program while it runs: takes commands, works out what they ask for and says how it went.
/// For one thread; what runs elsewhere is handed over by update().
///
/// Sets the state at once; answers follow. A change that concerns the answer starts work that
/// reuses what it can (HeatMethod::with) and replaces what still waits: the latest wins. Work on
/// settings that no longer hold is cancelled; a query whose sources alone have changed is let
/// finish, so that the picture follows a drag. A failure leaves what is shown and goes to the log.
class Session {
 public:
  explicit Session(SessionHooks hooks = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Errors: the command's, also written to the log; the state is then unchanged. Where work has
  /// threads of its own, distances are written there: what fails then is a failure of work.
  Result<void> submit(const Command& command);
  /// The same for several, with one answer for where they lead. Ends with the first error.
  Result<void> submit_all(std::span<const Command> commands);

  /// Takes over finished work. True when something changed.
  bool update();
  /// Waits for all work, of scripts as well, and takes it over. Errors: the first failure of work
  /// or script since the last call.
  Result<void> finish();

  /// While a drag goes on, answers come without quality figures: the query and nothing else.
  void set_dragging(bool dragging);

  const ViewerState& state() const;
  const Explored& explored() const;
  /// What is shown does not belong to the state: work goes on, or it failed.
  bool stale() const;
  SessionWork work() const;
  /// What runs now, and files that wait to be written. A check alone ends without a failure: what
  /// is shown is right.
  void cancel();
  const std::string& failure() const;  ///< of the last work; empty: it went well
  bool can_undo() const;
  bool can_redo() const;
  /// True once that is asked for and no file is being written. A file that cannot be written takes
  /// the wish back, so that its user sees why.
  bool quits() const;

  /// Adds a line to the log.
  void say(LogLine::Kind kind, std::string text);
  void say(const Error& error);
  /// Everything that is to be known, oldest first; the last few thousand lines.
  std::span<const LogLine> log() const;
  std::span<const QueryRecord> queries() const;  ///< the last ones, oldest first
  const SessionCompare& compare() const;

  /// Solves with several time factors in the background and holds each answer against a better
  /// method, unless that has been done for what is shown or goes on. Precondition: the answer of A
  /// is by the heat method. Where work goes on or waits, nothing happens yet.
  void study();
  /// The error over time factors of what is shown, whatever its own factor is; empty where study()
  /// has not been asked for it.
  const SessionStudy& error_study() const;

  /// The commands since the start as a script; drags of the camera in one line each.
  std::string script() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace geotherm::app
