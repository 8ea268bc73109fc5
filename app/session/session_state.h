// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "app/session/command.h"
#include "app/session/explorer.h"
#include "app/session/script.h"
#include "app/session/session.h"
#include "app/session/wording.h"
#include "geotherm/progress.h"

// What session*.cpp share.
namespace geotherm::app {

/// A thread that does one job at a time. Of the jobs that wait only the latest is kept. It gives
/// way to other threads where the machine is busy, so that frames come first.
class Worker {
 public:
  /// Asked to stop, a job sees its progress return false. Must not throw.
  using Job = std::function<void(const Progress& progress)>;

  /// `changed` is called, from the worker's thread, when busy() or stage() may have changed.
  explicit Worker(std::function<void()> changed);
  /// Cancels and waits.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Replaces what waits. `cancel_running`: what runs now is asked to stop.
  void start(Job job, bool cancel_running);
  bool cancel();  ///< what runs, and what waits; true: something has waited, which will not run
  void wait();    ///< until nothing runs or waits

  struct Status {
    bool busy = false;
    std::string stage;
    double share = -1;  ///< negative: unknown
  };
  Status status() const;

 private:
  void work(const std::stop_token& stop);
  bool take_progress(std::string_view stage, double share);

  std::function<void()> changed_;
  mutable std::mutex mutex_;
  std::condition_variable_any work_there_, idle_;
  Job waiting_;
  bool running_ = false, cancelled_ = false;
  std::string stage_;
  double share_ = -1;
  std::jthread thread_;  // last: it uses all of the above
};

/// What takes long of a save. Needs nothing of the session any more, and stops as work does.
using Writing = std::function<Result<void>(const Progress& progress)>;

struct Session::State {
  explicit State(SessionHooks given) : hooks(std::move(given)) {}

  /// Whom a command comes from: a script may have been written by anybody.
  enum class Giver { kUser, kScript };

  // session.cpp: commands.
  Result<void> submit(const Command& command, const Session& session, Giver giver);
  Result<void> perform(const Command& command, const Session& session, Giver giver);
  Result<void> run_script(const std::string& path);
  void pump(const Session& session);
  void note_asked(const Command& command);
  std::string lines_to_blame(ExplorePart part) const;
  Result<void> check_picked(const ViewerState& next) const;
  void step_back(std::vector<ViewerState>& from, std::vector<ViewerState>& to);
  bool close_opening();
  bool leave_frame();
  void note(LogLine::Kind kind, std::string text, Hint hint = {});
  void note(LogLine::Kind kind, const Warning& said) { note(kind, said.message, said.hint); }
  void note(const Error& error) { note(LogLine::Kind::kError, warning_of(error)); }

  // session_work.cpp: what runs elsewhere.
  ExploreRequest wanted() const;
  bool only_checks() const;
  void refresh();
  bool leave_out_centre(const ExploreRequest& request);
  void start(const ExploreRequest& request);
  bool take();
  void say_failure(const Error& error, ExplorePart part);
  void look_head_on();
  bool take_more_of_model(const std::shared_ptr<const ExploredModel>& model);
  void note_model(const ExploredModel& before);
  void note_warnings(const Explored& before);
  void note_error(const Explored& before);
  void note_centre(const Explored& before);
  void take_answer(const ExploreRequest& request, Result<Explored> answer,
                   ExplorePart part = ExplorePart::kMethod);
  Result<void> start_compare(const command::Compare& command);
  ExploreRequest studied_request() const;
  void start_study();
  void stop_study();
  bool works();

  // session_files.cpp: what is written.
  Result<void> save(const Command& command, const Session& session, Giver giver);
  Result<void> check_place(const Command& command, Giver giver) const;
  Result<void> check_written(const std::string& path) const;
  void start_save();
  void take_saved(const Result<void>& done);
  void stop_saves();
  void note_saved(const std::string& path, Giver giver);

  SessionHooks hooks;
  ViewerState state = initial_state();
  Explored explored;
  std::vector<ViewerState> undo, redo;
  std::optional<Command> last_undoable;
  CommandLog commands;
  bool last_logged_merges = false;
  std::vector<LogLine> log;
  std::vector<QueryRecord> queries;
  SessionCompare compare;
  std::string failure;
  std::optional<Error> first_error;
  std::deque<std::pair<std::string, ScriptLine>> script;  ///< where from, what
  struct Place {
    std::string script;
    int number = 0;
    std::string text() const { return script + ": line " + std::to_string(number); }
  };
  std::optional<Place> at_work;  ///< the line of a script that is performed now
  struct Asked {
    std::optional<ExplorePart> part;  ///< none: it may have changed any
    Place at;
  };
  std::vector<Asked> asked;  ///< in their order, since the last answer
  int scripts_run = 0;
  std::set<std::string> saved_by_scripts;  ///< full paths, without links
  struct Save {
    Command command;
    Giver giver;
    std::optional<Place> at;  ///< in a script
    Writing write;
  };
  std::deque<Save> unwritten;  ///< in their order; the worker has the first
  void fail_save(const Save& save, Error error);
  std::uint64_t opening = 0, last_opening = 0;
  struct Before {
    ViewerState state;
    std::uint64_t opening;
    std::vector<ViewerState> undo, redo;
  };
  std::optional<Before> before_opening;  ///< while it is not known whether the model opens
  /// A command has said from where the model is seen, since it was opened.
  bool is_turned = false;
  bool dragging = false, quits = false;

  std::optional<ExploreRequest> requested;  ///< the last that was started
  std::optional<ExploreRequest> answered;   ///< what `explored` answers

  // From the workers. Each message is taken by take().
  struct Early {
    std::uint64_t opening;
    Explored explored;
    ExploreRequest request;  ///< what it answers, where it does
  };
  struct Answered {
    ExploreRequest request;
    Result<Explored> answer;
    ExplorePart part = ExplorePart::kModel;  ///< that it came to
  };
  struct Studied {
    std::uint64_t number;  ///< of State::studies
    SessionStudy study;    ///< as far as it is
  };
  struct Compared {
    std::uint64_t number;  ///< of State::compares
    Result<std::vector<CompareRow>> rows;
  };
  struct Saved {
    Result<void> done;  ///< of the first of State::unwritten
  };
  std::mutex inbox_mutex;
  using Message = std::variant<Early, Answered, Compared, Studied, Saved>;
  std::vector<Message> inbox;
  void post(Message message);

  /// What the last study is of: what is asked for, but for the time factor.
  std::optional<ExploreRequest> studied;
  SessionStudy study;
  std::uint64_t studies = 0, compares = 0;  ///< so many were started

  Explorer explorer;                                          ///< the worker's
  std::optional<Worker> worker, compare_worker, save_worker;  // last: they use all of the above
};

}  // namespace geotherm::app
