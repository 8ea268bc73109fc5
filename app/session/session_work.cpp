// SPDX-License-Identifier: MIT
// What a session has worked out, on its worker's thread or at once.
#include <algorithm>
#include <new>
#include <utility>

#include "app/picture/picture_scale.h"
#include "app/picture/picture_text.h"
#include "app/session/compare.h"
#include "app/session/explored.h"
#include "app/session/session_state.h"
#include "app/session/sources.h"
#include "app/session/wording.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

constexpr std::size_t kMaxQueries = 240;
constexpr int kCompareQueries = 10;
constexpr int kCompareBatch = 16;

std::string summary(const Explored& explored, const Explored& before) {
  const Answer& a = *explored.a;
  std::string text = "solved with " + solver_at_work(*a.method, a.result) + ": query " +
                     milliseconds(a.result.timing.query) + " ms";
  if (!before.a || before.a->method != a.method)
    text += ", set-up " + milliseconds(a.setup_ms) + " ms";
  text += ", largest distance " + significant(a.distance.max);
  if (explored.difference) {
    text += "; A - B: at most " + significant(explored.difference->most) + ", mean " +
            significant(explored.difference->mean);
  }
  return text;
}

/// Whether one is the other, perhaps sculpted: both have one copy of the faces.
bool is_same_surface(const ExploredModel& a, const ExploredModel& b) {
  return a.model.mesh->faces().data() == b.model.mesh->faces().data();
}

/// What is asked for but for what follows once answers are shown: their check, a centre.
ExploreRequest answers_of(ExploreRequest request) {
  if (request.check == Check::kOn) request.check = Check::kOff;
  request.centre.reset();
  return request;
}

}  // namespace

ExploreRequest Session::State::wanted() const {
  ExploreRequest request;
  static_cast<Question&>(request) = state;
  request.opening = opening;
  request.pose = {state.timeline.sequence, state.timeline.frame, state.sculpture};
  request.fields = needs_fields(state.picture.view) || state.picked.has_value();
  request.quality = !dragging;
  const View view = state.picture.view;
  request.check = state.check;
  if (view == View::kExactError) request.check = std::max(request.check, Check::kAuto);
  // What moves is not checked: it comes to rest first.
  if (dragging && request.check == Check::kOn) request.check = Check::kOff;
  if (dragging) request.centre.reset();
  request.nearest = view == View::kRegions;
  return request;
}

bool Session::State::works() {
  const std::lock_guard lock(inbox_mutex);
  return !inbox.empty() || compare.running || (worker && worker->status().busy);
}

/// Whether what was asked for last is shown, and only its check or a centre is missing.
bool Session::State::only_checks() const {
  return requested && (requested->check == Check::kOn || requested->centre) && answered &&
         answered->covers(answers_of(*requested));
}

/// Starts what the state asks for and nobody works on.
void Session::State::refresh() {
  if (state.model.empty()) return;
  const ExploreRequest request = wanted();
  if (requested && requested->covers(request) && leave_out_centre(request)) {
    // What is shown belongs to the state: a model that did not open is a matter of the log.
    if (answered && answered->covers(request) && !explored.b_failure) failure.clear();
    return;
  }
  start(request);
}

/// Shows no centre where none is asked for. False where one is still looked for.
bool Session::State::leave_out_centre(const ExploreRequest& request) {
  if (request.centre || !requested->centre) return true;
  if (!answered || !answered->covers(*requested)) return false;
  requested->centre.reset();
  answered->centre.reset();
  explored.centre.reset();
  explored.centre_failure.reset();
  ++explored.version;
  return true;
}

void Session::State::start(const ExploreRequest& request) {
  // An answer that is shown and only checked gives way to the next one.
  const bool cancel = only_checks() || (requested && !requested->same_setup(request));
  requested = request;
  failure.clear();
  const auto job = [this, request](const Progress& progress) {
    Answered message{request, explorer.explore(request, progress, [&](Explored early) {
                       post(Early{request.opening, std::move(early), answers_of(request)});
                     })};
    message.part = explorer.part();
    post(std::move(message));
  };
  if (worker) {
    worker->start(job, cancel);
    return;
  }
  job(hooks.progress);
  take();
}

void Session::State::post(Message message) {
  {
    const std::lock_guard lock(inbox_mutex);
    inbox.push_back(std::move(message));
  }
  if (hooks.wake) hooks.wake();
}

bool Session::State::take() {
  std::vector<Message> messages;
  {
    const std::lock_guard lock(inbox_mutex);
    messages.swap(inbox);
  }
  for (auto& message : messages) {
    if (auto* early = std::get_if<Early>(&message)) {
      if (early->opening != opening) continue;  // of a model that is no longer wanted
      if (early->explored.a) {
        take_answer(early->request, std::move(early->explored));
        continue;
      }
      if (take_more_of_model(early->explored.model)) continue;
      // An answer on a frame or on strokes stays when the next one fails.
      if (explored.a && is_same_surface(*explored.model, *early->explored.model)) continue;
      const std::uint64_t version = explored.version;
      explored = std::move(early->explored);
      explored.version = version + 1;
      before_opening.reset();
      note(LogLine::Kind::kNote, "opened " + one_line(explored.model->model.name) + ": " +
                                     grouped(explored.model->model.mesh->vertex_count()) +
                                     " vertices, " + size_in_words(explored.model->model));
      look_head_on();
    } else if (auto* answered_now = std::get_if<Answered>(&message)) {
      take_answer(answered_now->request, std::move(answered_now->answer), answered_now->part);
    } else if (auto* saved = std::get_if<Saved>(&message)) {
      take_saved(saved->done);
    } else if (auto* part = std::get_if<Studied>(&message)) {
      if (part->number == studies) study = std::move(part->study);
    } else if (auto* compared = std::get_if<Compared>(&message)) {
      if (compared->number != compares) continue;  // another one has taken its place
      compare.running = false;
      if (compared->rows) {
        compare.rows = *std::move(compared->rows);
        note(LogLine::Kind::kNote,
             "compared " + counted(static_cast<Index>(compare.rows.size()), "backend", "backends"));
      } else {
        note(compared->rows.error());
      }
    }
  }
  return !messages.empty();
}

/// The model that is open with what was missing: light, or that it can be picked on. False: it is
/// another one.
bool Session::State::take_more_of_model(const std::shared_ptr<const ExploredModel>& model) {
  if (!explored.model || explored.model->model.mesh != model->model.mesh) return false;
  if (explored.model->base != model->base) ++explored.version;
  note_model(*std::exchange(explored.model, model));
  return true;
}

/// What is warned of a model once it is described; `before` is what was shown.
void Session::State::note_model(const ExploredModel& before) {
  if (before.mesh || !explored.model->mesh) return;
  for (const Warning& warning : explored.model->warnings) note(LogLine::Kind::kWarning, warning);
}

/// A grid of one layer is looked at head-on, where nobody has turned it yet.
void Session::State::look_head_on() {
  const auto angles = head_on(explored.model->model);
  const CameraSettings& camera = state.picture.camera;
  if (!angles || is_turned || !is_seen_as_usual(camera)) return;
  const command::Place place{(*angles)[0], (*angles)[1], camera.zoom, camera.pan_right,
                             camera.pan_up};
  state = *app::apply(state, place);
  commands.add(place, state);
  note(LogLine::Kind::kCommand, commands.last_line());
}

void Session::State::say_failure(const Error& error, ExplorePart part) {
  failure = sentence(error);
  const std::string line = lines_to_blame(part);
  if (!first_error) first_error = line.empty() ? error : about(line, error);
  note(error);
}

void Session::State::take_answer(const ExploreRequest& request, Result<Explored> answer,
                                 ExplorePart part) {
  const bool is_last = requested && requested->covers(request) && request.covers(*requested);
  if (!answer) {
    if (!is_last) return;  // the request was superseded; its failure is not reported
    const bool cancelled = answer.error().code == ErrorCode::kCancelled;
    if (cancelled && only_checks()) {
      failure.clear();  // what is shown is right
      return;
    }
    const bool said = cancelled && !failure.empty();
    if (!said) say_failure(answer.error(), part);
    const bool no_frame = !cancelled && part == ExplorePart::kFrame;
    if (close_opening() ? explored.model != nullptr : no_frame && leave_frame()) refresh();
    return;
  }
  if (request.opening != opening) return;  // of a model that is no longer wanted
  const std::uint64_t version = explored.version;
  const Explored before = std::exchange(explored, *std::move(answer));
  explored.version = version + 1;
  if (before.model) note_model(*before.model);
  answered = request;
  if (is_last) failure.clear();
  if (is_last && explored.b_failure) say_failure(*explored.b_failure, ExplorePart::kMethod);
  if (auto there = check_picked(state); !there) {
    say_failure(there.error(), ExplorePart::kTarget);
    state.picked.reset();
  }
  if (is_last) asked.clear();
  if (!explored.a) return;
  if (explored.shown) {
    note_centre(before);
    note_error(before);
    return;
  }
  if (queries.size() >= kMaxQueries) queries.erase(queries.begin());
  queries.push_back(
      {solver_at_work(*explored.a->method, explored.a->result), explored.a->result.timing});
  if (!request.quality) return;  // a drag goes on
  note(LogLine::Kind::kNote, summary(explored, before));
  const View view = state.picture.view;
  if (needs_fields(view) && explored.a->method->heat() == nullptr) {
    note(LogLine::Kind::kWarning,
         {"the view " + geotherm::to_text(view) + " shows the heat u, which the method " +
              to_text(explored.a->options.method) + " has not",
          {"set ", SettingHint{"method", {"heat"}}}});
  }
  if (const auto& none = explored.path_failure; none && none != before.path_failure) {
    note(LogLine::Kind::kWarning, "no paths: " + none->message, none->hint);
  }
  note_warnings(before);
}

/// What an answer warns of and the one before it did not.
void Session::State::note_warnings(const Explored& before) {
  for (const Warning& warning : explored.a->warnings) {
    const bool known = before.a && is_same_surface(*before.model, *explored.model) &&
                       std::ranges::find(before.a->warnings, warning) != before.a->warnings.end();
    if (!known) note(LogLine::Kind::kWarning, warning);
  }
}

void Session::State::note_centre(const Explored& before) {
  if (const auto& none = explored.centre_failure; none && none != before.centre_failure) {
    note(LogLine::Kind::kWarning, "no centre: " + none->message, none->hint);
  }
  if (!explored.centre || explored.centre == before.centre) return;
  const Centres& centres = explored.centre->centres;
  note(LogLine::Kind::kNote, geotherm::to_text(explored.centre->kind) + " of the sources: energy " +
                                 significant(centres.found.front().energy));
  for (const Warning& warning : centres.warnings) note(LogLine::Kind::kWarning, warning);
}

/// How wrong the answer is that was shown before.
void Session::State::note_error(const Explored& before) {
  const auto& error = explored.a->error;
  const bool known = before.a && before.a->error == error;
  if (error && error->measured && !error->is_poor() && !known) {
    Warning line = accuracy_line(*error);
    line.message.insert(0, "error: ");
    note(LogLine::Kind::kNote, line);
  }
  note_warnings(before);
}

Result<void> Session::State::start_compare(const command::Compare& command) {
  CompareTask task;
  auto solvers = solvers_named(command.backends, state.options);
  if (!solvers) return solvers.error();
  task.solvers = *std::move(solvers);
  task.reference = solver_name(task.solvers.front());
  task.queries.push_back(explored.set);
  for (int i = 1; i < kCompareBatch; ++i) {
    const auto random = random_vertices(explored.model->model, 1, static_cast<std::uint64_t>(i));
    if (!random) break;
    const SourceSet set = SourceSet::of_vertices(*random);
    if (i < kCompareQueries) task.queries.push_back(set);
    task.batch.push_back(set);
  }
  task.batch.push_back(explored.set);
  compare.running = true;
  compare.rows.clear();
  compare.reference = task.reference;
  const auto job = [this, number = ++compares, task,
                    model = explored.model](const Progress& progress) {
    try {
      post(Compared{number, compare_backends(model->model, task, progress)});
    } catch (const std::bad_alloc&) {
      post(Compared{number,
                    Error{ErrorCode::kOutOfMemory, "the memory ended while comparing backends"}});
    }
  };
  if (compare_worker) {
    // One after the other: a study that goes on gives way and begins again afterwards.
    if (study.running) {
      ++studies;
      studied.reset();
      study = {};
    }
    compare_worker->start(job, true);
    return {};
  }
  job(hooks.progress);
  take();
  return {};
}

bool Session::stale() const {
  const State& s = *state_;
  if (s.state.model.empty()) return false;
  ExploreRequest wanted = s.wanted();
  wanted.fields = wanted.quality = false;
  wanted = answers_of(std::move(wanted));
  return !s.answered || !s.answered->covers(wanted);
}

SessionWork Session::work() const {
  const State& s = *state_;
  for (const std::optional<Worker>* worker : {&s.save_worker, &s.worker, &s.compare_worker}) {
    if (!*worker) continue;
    const Worker::Status status = (*worker)->status();
    if (status.busy) return {true, status.stage, status.share};
  }
  return {};
}

void Session::cancel() {
  State& s = *state_;
  if (s.compare_worker) s.compare_worker->cancel();
  s.stop_study();
  s.stop_saves();
  s.compare.running = false;  // one that waited says nothing any more
  if (!s.worker || !s.worker->status().busy) return;
  s.worker->cancel();
  if (s.only_checks()) {
    const bool centre = s.requested->centre && !s.explored.centre;
    return s.note(LogLine::Kind::kNote,
                  centre ? "the search for the centre was cancelled" : "the check was cancelled");
  }
  s.close_opening();
  // What waited says nothing any more, so it is said here.
  s.first_error = Error{
      ErrorCode::kCancelled, "the work was cancelled", {"change something to start it again"}};
  s.failure = sentence(*s.first_error);
  s.note(*s.first_error);
}

}  // namespace geotherm::app
