// SPDX-License-Identifier: MIT
// What a session writes.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

#include "app/session/machine.h"
#include "app/session/model.h"
#include "app/session/model_solver.h"
#include "app/session/outputs.h"
#include "app/session/progress.h"
#include "app/session/report.h"
#include "app/session/script.h"
#include "app/session/session_state.h"
#include "app/session/settings.h"
#include "app/text/text.h"
#include "geotherm/io.h"
#include "solver/mesh/io/mask_numbers.h"

namespace geotherm::app {
namespace {

/// What sessions and logs begin with.
std::string script_head() {
  std::string head = "# geotherm commands; see docs/commands.md\n";
  return head.append(kInertLine).append("\n");
}

Error not_yet(const char* what) {
  return {ErrorCode::kBadInput,
          std::string("there are no ") + what + " yet",
          {"open a model, give it a source and wait for the answer"}};
}

/// One name for each file.
std::string full_path(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::weakly_canonical(path, unknown).string();
}

/// The file of a command, never one that the session shows.
Result<Outputs> output_file(const ViewerState& state, const std::string& path,
                            const char* command) {
  Outputs outputs = outputs_beside(state);
  if (auto expected = outputs.expect(path, command); !expected) return expected.error();
  return outputs;
}

Result<void> write_text(const ViewerState& state, const std::string& path, const char* command,
                        const std::string& text) {
  auto outputs = output_file(state, path, command);
  if (!outputs) return outputs.error();
  std::string unused;
  return outputs->write_text(path, text, unused);
}

/// The distances shown in a file, with their nearest sources where it holds them: a solve of its
/// own, unless they are known.
Result<void> write_shown(const std::string& path, const Explored& explored, Shown shown,
                         Outputs& outputs, const Progress& progress) {
  const Answer& answer = *shown_answer(explored, shown);
  const bool difference = shown == Shown::kDifference && explored.difference;
  const std::vector<double>& values =
      difference ? explored.difference->values : answer.result.distances;
  const Model& model = explored.model->model;
  std::vector<Index> nearest;
  if (holds_mesh(path) && source_groups(explored.set).count > 1) {
    nearest = answer.result.nearest_source;
    if (nearest.empty()) {
      ModelSolver solver(model);
      auto found =
          solver.nearest_sources(explored.set, answer.result.distances, answer.options.threads,
                                 with_prefix(progress, "nearest sources: "));
      if (!found) return found.error();
      nearest = *std::move(found);
    }
  }
  if (!report(progress, "writing", -1)) return cancelled_error();
  return outputs.write(path, [&] { return write_answer(path, model, values, nearest, {}); });
}

/// Checks all that can be checked at once.
Result<Writing> writing_of(const command::SaveDistances& save, const Session& session) {
  const Shown shown = session.state().shown;
  if (shown_answer(session.explored(), shown) == nullptr || session.stale()) {
    return not_yet("distances");
  }
  auto outputs = output_file(session.state(), save.path, "save distances");
  if (!outputs) return outputs.error();
  const Model& model = session.explored().model->model;
  if (auto fits = check_answer_path(model, save.path); !fits) return fits.error();
  return Writing([path = save.path, explored = session.explored(), shown,
                  file = std::make_shared<Outputs>(*std::move(outputs))](const Progress& progress) {
    return write_shown(path, explored, shown, *file, progress);
  });
}

Result<void> save_mesh(const command::SaveMesh& save, const Session& session) {
  const Explored& explored = session.explored();
  if (!explored.model || session.stale()) return not_yet("vertices");
  if (auto surface = refuse_space(explored.model->model, "saved meshes are"); !surface) {
    return surface;
  }
  auto outputs = output_file(session.state(), save.path, "save mesh");
  if (!outputs) return outputs.error();
  return outputs->write(save.path,
                        [&] { return write_mesh(save.path, *explored.model->model.mesh); });
}

Result<void> save_figures(const command::SaveFigures& save, const Session& session) {
  const Explored& explored = session.explored();
  const Answer* answer = shown_answer(explored, session.state().shown);
  if (answer == nullptr || session.stale()) return not_yet("figures");
  return write_text(session.state(), save.path, "save figures", report_text(solve_json(*answer)));
}

/// What makes a picture that is drawn elsewhere as large as it is seen here, with its letters.
std::string size_seen(const ViewerState& state, const SessionHooks& hooks) {
  if (!hooks.seen) return {};
  ViewerState seen = state;
  seen.picture = hooks.seen();
  std::string text;
  for (const char* name : {"size", "text-size"}) {
    const std::string value = find_setting(name)->get(seen);
    if (value != find_setting(name)->get(state)) {
      text += to_text(command::Set{name, value}) + '\n';
    }
  }
  return text.empty() ? text : kSeenLine + ('\n' + text);
}

/// `is_placed`: said from where it is seen, also where that is as usual.
std::string session_text(const ViewerState& state, bool is_placed) {
  std::string text = script_head() + to_text(command::Reset{}) + '\n';
  for (const Command& command : commands_to(state)) text += to_text(command) + '\n';
  const CameraSettings& camera = state.picture.camera;
  if (is_placed && is_seen_as_usual(camera)) {
    text += to_text(command::Place{camera.azimuth, camera.elevation, camera.zoom, camera.pan_right,
                                   camera.pan_up}) +
            '\n';
  }
  return text;
}

}  // namespace

Outputs outputs_beside(const ViewerState& state) {
  Outputs outputs;
  if (!is_bundled(state.model)) outputs.protect(state.model, "the model itself");
  outputs.protect(state.timeline.sequence, "a frame of the sequence");
  outputs.protect(state.field, "the field itself");
  outputs.protect(io::parse_mask_text(state.reading.mask).path, "the mask itself");
  return outputs;
}

Result<void> Session::State::check_written(const std::string& path) const {
  const auto is_there = [full = full_path(path)](const Save& save) {
    return full_path(*saved_path(save.command)) == full;
  };
  if (std::ranges::none_of(unwritten, is_there)) return {};
  return Error{ErrorCode::kBadInput, one_line(path) + " is still being written", {"wait for it"}};
}

Result<void> Session::State::check_place(const Command& command, Giver giver) const {
  if (auto named = check_saved_name(command); !named) return named;
  if (auto free = check_written(*saved_path(command)); !free) return free;
  // A user has been asked, or knows. Scripts may replace what scripts of this run have written.
  if (giver == Giver::kUser || saved_by_scripts.contains(full_path(*saved_path(command))))
    return {};
  return check_replaced_by_script(command);
}

Result<void> Session::State::save(const Command& command, const Session& session, Giver giver) {
  const std::string& path = *saved_path(command);
  if (auto allowed = check_place(command, giver); !allowed) return allowed;
  Result<void> done;
  if (const auto* picture = std::get_if<command::SavePicture>(&command)) {
    if (!hooks.save_picture) {
      return Error{ErrorCode::kNotAvailable, "pictures cannot be drawn here"};
    }
    if (!explored.model) return not_yet("pictures");
    done = hooks.save_picture(*picture, session);
  } else if (const auto* distances = std::get_if<command::SaveDistances>(&command)) {
    auto writing = writing_of(*distances, session);
    if (!writing) return writing.error();
    if (save_worker) {
      unwritten.push_back({command, giver, at_work, *std::move(writing)});
      if (unwritten.size() == 1) start_save();
      return {};
    }
    done = (*writing)(hooks.progress);
  } else if (const auto* mesh = std::get_if<command::SaveMesh>(&command)) {
    done = save_mesh(*mesh, session);
  } else if (const auto* figures = std::get_if<command::SaveFigures>(&command)) {
    done = save_figures(*figures, session);
  } else if (std::holds_alternative<command::SaveSession>(command)) {
    // A grid would be turned head-on when it opens.
    const bool is_placed =
        before_opening ? is_turned : explored.model && head_on(explored.model->model);
    done = write_text(state, path, "save session",
                      session_text(state, is_placed) + size_seen(state, hooks));
  } else if (std::holds_alternative<command::SaveLog>(command)) {
    done = write_text(state, path, "save log",
                      script_head() + commands.script() + size_seen(state, hooks));
  }
  if (done) note_saved(path, giver);
  return done;
}

void Session::State::note_saved(const std::string& path, Giver giver) {
  if (giver == Giver::kScript) {
    saved_by_scripts.insert(full_path(path));
  } else {
    saved_by_scripts.erase(full_path(path));
  }
  note(LogLine::Kind::kNote, "wrote " + one_line(path));
  log.back().has_written = giver == Giver::kUser;
}

/// Has the first of what waits written.
void Session::State::start_save() {
  const auto job = [this, path = *saved_path(unwritten.front().command),
                    write = std::make_shared<Writing>(std::move(unwritten.front().write))](
                       const Progress& progress) {
    try {
      post(Saved{(*write)(with_prefix(progress, "saving: "))});
    } catch (const std::bad_alloc&) {
      post(Saved{
          Error{ErrorCode::kOutOfMemory, "the memory ended while writing " + one_line(path)}});
    }
  };
  save_worker->start(job, false);
}

/// How the first ended; the next one follows.
void Session::State::take_saved(const Result<void>& done) {
  const Save save = std::move(unwritten.front());
  unwritten.pop_front();
  if (done) {
    note_saved(*saved_path(save.command), save.giver);
  } else {
    fail_save(save, done.error());
  }
  if (!unwritten.empty()) start_save();
}

/// The one at work says itself how it ends.
void Session::State::stop_saves() {
  if (unwritten.empty()) return;
  const auto waiting = unwritten.begin() + (save_worker->cancel() ? 0 : 1);
  for (auto save = waiting; save != unwritten.end(); ++save) fail_save(*save, cancelled_error());
  unwritten.erase(waiting, unwritten.end());
}

/// A window stays open where its user would not see why there is no file.
void Session::State::fail_save(const Save& save, Error error) {
  commands.drop_last(save.command);
  if (error.code == ErrorCode::kCancelled) {
    error = about(one_line(*saved_path(save.command)), error);
  } else if (std::exchange(quits, false)) {
    commands.drop_last(command::Quit{});
  }
  // What a user has saved beside a script does not end it.
  if (!first_error && (save.at || script.empty())) {
    first_error = save.at ? about(save.at->text(), error) : error;
  }
  note(error);
}

}  // namespace geotherm::app
