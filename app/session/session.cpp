// SPDX-License-Identifier: MIT
#include "app/session/session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/picture/picture_scale.h"
#include "app/session/script.h"
#include "app/session/session_state.h"
#include "app/session/settings.h"
#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

constexpr std::size_t kMaxLogLines = 4000;
constexpr std::size_t kMaxUndo = 200;
/// Scripts that run scripts end here: most likely they run each other.
constexpr int kMaxScripts = 100;

/// Those that need answers that belong to the state.
bool needs_answers(const Command& command) {
  return is_any_of<command::SavePicture, command::SaveDistances, command::SaveMesh,
                   command::SaveFigures, command::Compare, command::Quit>(command);
}

/// The part of a request that a command changes; none: it changes nothing of it.
std::optional<ExplorePart> changed_part(const Command& command) {
  using enum ExplorePart;
  if (const auto* set = std::get_if<command::Set>(&command)) {
    const Setting* const setting = find_setting(set->name);
    if (setting == nullptr || setting->of_picture()) return {};
    return setting->group == SettingGroup::kModel ? kModel : kMethod;
  }
  if (is_any_of<command::Open>(command)) return kModel;
  if (is_any_of<command::ShowSequence, command::ShowFrame>(command)) return kFrame;
  if (is_any_of<command::Sculpt, command::ExtendStroke>(command)) return kStrokes;
  if (is_any_of<command::ShowField>(command)) return kField;
  if (is_any_of<command::Target, command::ShowCentre, command::Pick>(command)) return kTarget;
  if (is_any_of<command::Keep, command::MaxDistance>(command)) return kMethod;
  if (is_any_of<command::SetSources, command::AddSources, command::MoveSource,
                command::RemoveSource, command::ExtendCurve, command::MoreSources,
                command::FewerSources, command::ShuffleSources>(command)) {
    return kSources;
  }
  return {};
}

/// Whether it says from where the model is seen.
bool says_from_where(const Command& command) {
  if (const auto* set = std::get_if<command::Set>(&command)) {
    return set->name == "azimuth" || set->name == "elevation";
  }
  return is_any_of<command::Orbit, command::Place, command::Reset>(command);
}

bool same_but_camera(const ViewerState& a, ViewerState b) {
  b.picture.camera = a.picture.camera;
  b.rotating = a.rotating;
  b.timeline = a.timeline;
  b.picked = a.picked;
  return a == b;
}

}  // namespace

Session::Session(SessionHooks hooks) : state_(std::make_unique<State>(std::move(hooks))) {
  if (!state_->hooks.wake) return;
  state_->worker.emplace(state_->hooks.wake);
  state_->compare_worker.emplace(state_->hooks.wake);
  state_->save_worker.emplace(state_->hooks.wake);
}

Session::~Session() {
  // Where a window ends by an error, files that were asked for are written all the same.
  for (State& s = *state_; !s.unwritten.empty();) {
    s.save_worker->wait();
    s.take();
  }
}

void Session::State::note(LogLine::Kind kind, std::string text, Hint hint) {
  if (log.size() >= kMaxLogLines) log.erase(log.begin(), log.begin() + kMaxLogLines / 4);
  log.push_back({kind, std::move(text), std::move(hint)});
  last_logged_merges = kind == LogLine::Kind::kCommand;
}

void Session::State::step_back(std::vector<ViewerState>& from, std::vector<ViewerState>& to) {
  ViewerState back = std::move(from.back());
  from.pop_back();
  to.push_back(state);
  back.picture.camera = state.picture.camera;
  back.rotating = state.rotating;
  back.timeline = state.timeline;
  back.picked = state.picked;
  state = std::move(back);
  last_undoable.reset();
}

/// The model does not open: the one before it is still there. False: none was being opened.
bool Session::State::close_opening() {
  if (!before_opening) return false;
  state = std::move(before_opening->state);
  opening = before_opening->opening;
  undo = std::move(before_opening->undo);
  redo = std::move(before_opening->redo);
  before_opening.reset();
  requested = answered;
  commands.fail_last_open();
  return true;
}

/// A frame does not show: the one before it is shown again, or none where there was none. False:
/// that was asked for.
bool Session::State::leave_frame() {
  Timeline before;
  before.loop = state.timeline.loop;
  if (answered && answered->opening == opening) {
    before.sequence = answered->pose.sequence;
    before.frame = answered->pose.frame;
  }
  const bool same_sequence = before.sequence == state.timeline.sequence;
  if (same_sequence && before.frame == state.timeline.frame) return false;
  state.timeline = before;
  commands.fail_last_frame(!same_sequence);
  if (!before.sequence.empty()) {
    commands.add(command::ShowFrame{before.frame}, state);
    commands.add(command::Play{false}, state);
  }
  requested = answered;
  return true;
}

Result<void> Session::State::perform(const Command& command, const Session& session, Giver giver) {
  note_asked(command);
  if (std::holds_alternative<command::Undo>(command)) {
    if (undo.empty()) return Error{ErrorCode::kBadInput, "there is nothing to undo"};
    step_back(undo, redo);
    return {};
  }
  if (std::holds_alternative<command::Redo>(command)) {
    if (redo.empty()) return Error{ErrorCode::kBadInput, "there is nothing to redo"};
    step_back(redo, undo);
    return {};
  }
  if (std::holds_alternative<command::Quit>(command)) {
    quits = true;
    return {};
  }
  if (const auto* run = std::get_if<command::Run>(&command)) return run_script(run->path);
  if (const auto* wish = std::get_if<command::Compare>(&command)) {
    if (!explored.a) {
      return Error{ErrorCode::kBadInput,
                   "there is nothing to compare yet",
                   {"open a model and give it a source"}};
    }
    return start_compare(*wish);
  }
  if (saved_path(command) != nullptr) return save(command, session, giver);

  if (const auto* set = std::get_if<command::Set>(&command); set && set->name == "colour-map") {
    const auto& maps = hooks.colour_maps;
    if (!maps.empty() && std::ranges::find(maps, set->value) == maps.end()) {
      return Error{ErrorCode::kBadInput,
                   "there is no colour map '" + one_line(set->value) + "'",
                   {"there are " + joined(maps)}};
    }
  }
  if (const auto* open = std::get_if<command::Open>(&command)) {
    if (auto written = check_written(open->model); !written) return written;
  }
  auto next = app::apply(state, command);
  if (!next) return next.error();
  // A script may set the view that it fits later; whoever looks at the picture would see nothing.
  if (const auto* set = std::get_if<command::Set>(&command);
      set && set->name == "colour-scale" && giver == Giver::kUser) {
    const bool differences = next->kept || !next->field.empty();
    if (auto fits = check_scale_of_view(next->picture, differences); !fits) return fits;
  }
  if (std::holds_alternative<command::Pick>(command)) {
    if (auto there = check_picked(*next); !there) return there;
  }
  if (std::holds_alternative<command::Open>(command)) {
    if (!before_opening) before_opening = Before{state, opening, undo, redo};
    opening = ++last_opening;
    undo.clear();
    redo.clear();
    last_undoable.reset();
    is_turned = false;
  }
  is_turned = is_turned || says_from_where(command);
  if (undo_rule(command).undoable && *next != state) {
    if (!last_undoable || !continues(*last_undoable, command)) undo.push_back(state);
    if (undo.size() > kMaxUndo) undo.erase(undo.begin());
    redo.clear();
    last_undoable = command;
    if (!undo.empty() && same_but_camera(undo.back(), *next)) {
      // Dragged back to where it began: there is nothing to take back, as when it is replayed.
      undo.pop_back();
      last_undoable.reset();
    }
  }
  // Whoever asks again after a failure or a cancellation wants it tried again.
  if (undo_rule(command).undoable && !failure.empty()) requested.reset();
  state = *std::move(next);
  return {};
}

/// Keeps which lines of scripts have asked for what is not worked out yet.
void Session::State::note_asked(const Command& command) {
  const auto part = changed_part(command);
  const bool any = is_any_of<command::Undo, command::Redo, command::Reset, command::Swap>(command);
  if (!part && !any) return;
  // What people ask for besides may be at fault, too: then no line is named.
  if (any || !at_work || is_any_of<command::Open>(command)) asked.clear();
  if (is_any_of<command::SetSources, command::ShowField, command::Target>(command)) {
    std::erase_if(asked, [&part](const Asked& each) { return each.part == part; });
  }
  if (at_work) asked.push_back({part, *at_work});
}

/// Where in a script what failed was asked for, "FILE: line 3" or "FILE: lines 3 to 5" where any of
/// them may be at fault. Empty: in none, or its line is said anyway, where it ends.
std::string Session::State::lines_to_blame(ExplorePart part) const {
  using enum ExplorePart;
  if (at_work) return {};
  const auto lines_of = [this](auto&& concerns) {
    std::vector<Place> lines;
    for (const Asked& each : asked) {
      if (!each.part || concerns(*each.part)) lines.push_back(each.at);
    }
    return lines;
  };
  // Not each method takes each source.
  auto lines = lines_of(
      [part](ExplorePart each) { return each == part || (part == kMethod && each == kSources); });
  if (lines.empty()) lines = lines_of([](ExplorePart each) { return each == kModel; });
  if (lines.empty()) return {};
  const Place &first = lines.front(), &last = lines.back();
  if (first.number == last.number && first.script == last.script) return first.text();
  if (first.script != last.script) return first.text() + " to " + last.text();
  return first.script + ": lines " + std::to_string(first.number) + " to " +
         std::to_string(last.number);
}

/// Whether the model has the face that is picked, as far as it is known.
Result<void> Session::State::check_picked(const ViewerState& next) const {
  if (!next.picked || !explored.model || before_opening) return {};
  const Index faces = explored.model->model.mesh->face_count();
  if (next.picked->face < faces) return {};
  return Error{ErrorCode::kBadInput,
               "pick: there is no face " + std::to_string(next.picked->face),
               {"faces are 0 to " + std::to_string(faces - 1)}};
}

Result<void> Session::State::submit(const Command& command, const Session& session, Giver giver) {
  if (quits && std::holds_alternative<command::Quit>(command)) return {};  // it waits for files
  const bool saves = saved_path(command) != nullptr;
  if (saves && !hooks.writes_files) {
    note(LogLine::Kind::kNote, "not written: " + to_text(command));
    return {};
  }
  const bool said = saves || std::holds_alternative<command::Compare>(command);
  if (said) note(LogLine::Kind::kCommand, to_text(command));  // before what it has to say
  auto done = perform(command, session, giver);
  if (!done) {
    if (!said) note(LogLine::Kind::kCommand, to_text(command));
    note(done.error());
    return done;
  }
  if (const auto* run = std::get_if<command::Run>(&command)) {
    commands.add_comment("run " + one_line(run->path));
    note(LogLine::Kind::kCommand, to_text(command));
    last_logged_merges = false;
  } else {
    const bool merged = commands.add(command, state);
    if (merged && last_logged_merges) {
      log.back().text = commands.last_line();
    } else if (!said) {
      note(LogLine::Kind::kCommand, commands.last_line());
    }
  }
  return {};
}

Result<void> Session::State::run_script(const std::string& path) {
  if (++scripts_run > kMaxScripts) {
    script.clear();
    scripts_run = 0;
    return Error{
        ErrorCode::kBadInput,
        one_line(path) + ": " + std::to_string(kMaxScripts) + " scripts have run each other",
        {"end the circle"}};
  }
  auto lines = read_script(path);
  if (!lines) return lines.error();
  std::deque<std::pair<std::string, ScriptLine>> all;
  for (ScriptLine& line : *lines) all.emplace_back(one_line(path), std::move(line));
  script.insert(script.begin(), std::make_move_iterator(all.begin()),
                std::make_move_iterator(all.end()));
  return {};
}

/// Runs what scripts ask for, as far as it can be done now.
void Session::State::pump(const Session& session) {
  while (!script.empty() && !quits) {
    if (first_error) {
      note(LogLine::Kind::kError,
           "the script ends here: " +
               counted(static_cast<Index>(script.size()), "line was", "lines were") + " left out");
      script.clear();
      break;
    }
    if (!unwritten.empty()) break;  // where one fails, nothing that follows is done
    if (needs_answers(script.front().second.command)) {
      refresh();
      if (works()) return;
      if (first_error) continue;
    }
    const auto [name, line] = std::move(script.front());
    script.pop_front();
    if (line.unseen && hooks.seen) continue;  // a window has its own size and letters
    at_work = Place{name, line.number};
    const auto done = submit(line.command, session, Giver::kScript);
    if (!done && !first_error) first_error = done.error();
    if (first_error) first_error = about(at_work->text(), *first_error);
    at_work.reset();
  }
  if (script.empty()) scripts_run = 0;
  refresh();
}

Result<void> Session::submit(const Command& command) { return submit_all({&command, 1}); }

Result<void> Session::submit_all(std::span<const Command> commands) {
  State& s = *state_;
  if (s.script.empty()) s.first_error.reset();
  Result<void> done;
  for (const Command& command : commands) {
    if (done = s.submit(command, *this, State::Giver::kUser); !done) break;
  }
  s.pump(*this);
  if (!done || s.hooks.wake) return done;
  return finish();
}

bool Session::update() {
  const bool changed = state_->take();
  state_->pump(*this);
  return changed;
}

Result<void> Session::finish() {
  State& s = *state_;
  do {
    if (s.worker) s.worker->wait();
    if (s.compare_worker) s.compare_worker->wait();
    if (s.save_worker) s.save_worker->wait();
    s.take();
    s.pump(*this);
  } while (s.works() || !s.unwritten.empty() || (!s.script.empty() && !s.quits));
  const std::optional<Error> error = std::exchange(s.first_error, std::nullopt);
  return error ? Result<void>(*error) : Result<void>();
}

void Session::set_dragging(bool dragging) {
  if (state_->dragging == dragging) return;
  state_->dragging = dragging;
  state_->refresh();
}

void Session::say(LogLine::Kind kind, std::string text) { state_->note(kind, std::move(text)); }
void Session::say(const Error& error) { state_->note(error); }

const ViewerState& Session::state() const { return state_->state; }
const Explored& Session::explored() const { return state_->explored; }
const std::string& Session::failure() const { return state_->failure; }
bool Session::can_undo() const { return !state_->undo.empty(); }
bool Session::can_redo() const { return !state_->redo.empty(); }
bool Session::quits() const { return state_->quits && state_->unwritten.empty(); }
std::span<const LogLine> Session::log() const { return state_->log; }
std::span<const QueryRecord> Session::queries() const { return state_->queries; }
const SessionCompare& Session::compare() const { return state_->compare; }
std::string Session::script() const { return state_->commands.script(); }

}  // namespace geotherm::app
