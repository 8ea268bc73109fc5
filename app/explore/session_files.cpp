// SPDX-License-Identifier: MIT
// What a session writes.
#include "app/explore/session_state.h"
#include "app/load_model.h"
#include "app/machine.h"
#include "app/nearest_sources.h"
#include "app/outputs.h"
#include "app/report_json.h"
#include "app/text.h"
#include "solver/mesh/io/file_extension.h"
#include "solver/mesh/write_distances.h"

namespace geotherm::app {
namespace {

constexpr const char* kScriptHead = "# geotherm commands; see docs/commands.md\n";

Error not_yet(const char* what) {
  return {ErrorCode::kBadInput, std::string("there are no ") + what +
                                    " yet; open a model, give it a source and wait for the answer"};
}

/// The file of a command, never standard output and never the model.
Result<Outputs> output_file(const std::string& model, const std::string& path,
                            const char* command) {
  if (path == "-") {
    return Error{ErrorCode::kBadInput, std::string(command) + ": give the name of a file, not -"};
  }
  Outputs outputs;
  if (!is_bundled(model)) outputs.protect(model, "the model itself");
  if (auto expected = outputs.expect(path, command); !expected) return expected.error();
  return outputs;
}

Result<void> write_text(const std::string& model, const std::string& path, const char* command,
                        const std::string& text) {
  auto outputs = output_file(model, path, command);
  if (!outputs) return outputs.error();
  std::string unused;
  return outputs->write_text(path, text, unused);
}

Result<void> save_distances(const command::SaveDistances& save, const Session& session) {
  if (auto known = check_distance_path(save.path); !known) return known;
  const Explored& explored = session.explored();
  const Answer* answer = shown_answer(explored, session.state().shown);
  if (answer == nullptr || session.stale()) return not_yet("distances");
  const bool difference = session.state().shown == Shown::kDifference && explored.difference;
  const std::vector<double>& values =
      difference ? explored.difference->values : answer->result.distances;
  auto outputs = output_file(session.state().model, save.path, "save distances");
  if (!outputs) return outputs.error();
  const std::shared_ptr<const TriangleMesh>& mesh = explored.model->model.mesh;
  std::vector<Index> nearest;
  if (holds_mesh(save.path) && source_groups(explored.set).count > 1) {
    auto found =
        nearest_sources(mesh, explored.set, answer->result.distances, answer->options.threads, {});
    if (!found) return found.error();
    nearest = *std::move(found);
  }
  return outputs->write(save.path,
                        [&] { return write_distances(save.path, *mesh, values, nearest); });
}

Result<void> save_figures(const command::SaveFigures& save, const Session& session) {
  const Explored& explored = session.explored();
  const Answer* answer = shown_answer(explored, session.state().shown);
  if (answer == nullptr || session.stale()) return not_yet("figures");
  return write_text(session.state().model, save.path, "save figures",
                    to_text(solve_json(figures_of(explored, *answer))));
}

std::string session_text(const ViewerState& state) {
  std::string text = std::string(kScriptHead) + to_text(command::Reset{}) + '\n';
  for (const Command& command : commands_to(state)) text += to_text(command) + '\n';
  return text;
}

}  // namespace

Result<void> Session::State::save(const Command& command, const Session& session) {
  Result<void> done;
  std::string path;
  if (const auto* picture = std::get_if<command::SavePicture>(&command)) {
    path = picture->path;
    if (io::file_extension(path) != ".png") {
      return Error{ErrorCode::kBadInput,
                   one_line(path) + ": pictures are written as .png; name a FILE.png"};
    }
    if (!hooks.save_picture) {
      return Error{ErrorCode::kNotAvailable, "pictures cannot be drawn here"};
    }
    if (!explored.model) return not_yet("pictures");
    done = hooks.save_picture(*picture, session);
  } else if (const auto* distances = std::get_if<command::SaveDistances>(&command)) {
    path = distances->path;
    done = save_distances(*distances, session);
  } else if (const auto* figures = std::get_if<command::SaveFigures>(&command)) {
    path = figures->path;
    done = save_figures(*figures, session);
  } else if (const auto* text = std::get_if<command::SaveSession>(&command)) {
    path = text->path;
    done = write_text(state.model, path, "save session", session_text(state));
  } else if (const auto* whole = std::get_if<command::SaveLog>(&command)) {
    path = whole->path;
    done = write_text(state.model, path, "save log", kScriptHead + commands.script());
  }
  if (done) note(LogLine::Kind::kNote, "wrote " + one_line(path));
  return done;
}

}  // namespace geotherm::app
