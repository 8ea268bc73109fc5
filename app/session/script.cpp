// SPDX-License-Identifier: MIT
#include "app/session/script.h"

#include <algorithm>
#include <cerrno>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "app/session/command.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "geotherm/domains.h"
#include "geotherm/io.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

namespace fs = std::filesystem;

/// Nothing but blanks, a comment or the line that is there for shells.
bool is_empty(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#' || line == kInertLine;
}

Result<std::string> read_text(const std::string& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) {
    return Error{
        ErrorCode::kBadFile, one_line(path) + ": is a directory", {"name a file of commands"}};
  }
  if (!std::filesystem::exists(path, unknown)) {
    return Error{ErrorCode::kBadFile, one_line(path) + ": no such file", {"check the path"}};
  }
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.bad() && file.is_open()) return text;
  const std::string reason = std::error_code(errno, std::generic_category()).message();
  return Error{ErrorCode::kBadFile, one_line(path) + ": " + reason, {"name a file of commands"}};
}

/// What a command opens, where it lies in the script's folder and not in the current one.
void look_beside(const fs::path& folder, Command& command) {
  std::string* file = nullptr;
  if (auto* const open = std::get_if<command::Open>(&command)) file = &open->model;
  if (auto* const frames = std::get_if<command::ShowSequence>(&command)) file = &frames->path;
  if (auto* const run = std::get_if<command::Run>(&command)) file = &run->path;
  if (auto* const field = std::get_if<command::ShowField>(&command)) file = &field->path;
  if (auto* const set = std::get_if<command::Set>(&command);
      set != nullptr && set->name == "mask") {
    file = &set->value;
  }
  std::error_code unknown;
  if (file == nullptr || folder.empty() || fs::exists(*file, unknown)) return;
  const fs::path beside = folder / *file;
  if (fs::is_regular_file(beside, unknown)) *file = beside.string();
}

}  // namespace

Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<ScriptLine> lines;
  bool unseen = false;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end == std::string_view::npos ? end : end + 1));
    if (trimmed(line) == kSeenLine) unseen = true;
    if (is_empty(line)) continue;
    auto command = parse_command(line);
    if (!command) {
      return Error{
          ErrorCode::kBadFile,
          one_line(name) + ": line " + std::to_string(number) + ", " + command.error().message,
          command.error().hint};
    }
    lines.push_back({number, *std::move(command), unseen});
  }
  return lines;
}

Result<std::vector<ScriptLine>> read_script(const std::string& path) {
  const auto text = read_text(path);
  if (!text) return text.error();
  auto lines = parse_script(*text, path);
  if (!lines) return lines;
  const fs::path folder = fs::path(path).parent_path();
  for (ScriptLine& line : *lines) look_beside(folder, line.command);
  return lines;
}

bool is_session(const std::string& path) { return io::file_extension(path) == kSessionExtension; }

std::vector<std::string> files_written_by(const std::string& script) {
  std::vector<std::string> files;
  std::set<std::string> seen = {script};
  std::deque<std::string> left = {script};
  for (; !left.empty(); left.pop_front()) {
    const auto lines = read_script(left.front());
    if (!lines) continue;
    for (const ScriptLine& line : *lines) {
      const auto* const run = std::get_if<command::Run>(&line.command);
      if (run != nullptr && seen.insert(run->path).second) left.push_back(run->path);
      const std::string* const path = saved_path(line.command);
      if (path != nullptr && std::ranges::find(files, *path) == files.end()) {
        files.push_back(*path);
      }
    }
  }
  return files;
}

namespace {

bool moves_camera(const Command& command) {
  return is_any_of<command::Orbit, command::Zoom, command::Pan, command::Place>(command);
}

command::Place place_of(const CameraSettings& camera) {
  return {camera.azimuth, camera.elevation, camera.zoom, camera.pan_right, camera.pan_up};
}

}  // namespace

bool continues(const Command& before, const Command& now) {
  if (const auto* set = std::get_if<command::Set>(&now)) {
    const auto* last = std::get_if<command::Set>(&before);
    return undo_rule(now).merged && last != nullptr && last->name == set->name;
  }
  if (const auto* move = std::get_if<command::MoveSource>(&now)) {
    const auto* last = std::get_if<command::MoveSource>(&before);
    return last != nullptr && last->index == move->index;
  }
  if (is_any_of<command::ExtendCurve>(now)) {
    return is_any_of<command::ExtendCurve, command::AddSources>(before);
  }
  if (is_any_of<command::ExtendStroke>(now)) {
    return is_any_of<command::ExtendStroke, command::Sculpt>(before);
  }
  return is_any_of<command::ShowFrame>(now) && is_any_of<command::ShowFrame>(before);
}

namespace {

void append(auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); }

/// Makes `last` what both do. False: they need two lines. Precondition: continues(last, now).
bool merge(Command& last, const Command& now) {
  if (const auto* more = std::get_if<command::ExtendCurve>(&now)) {
    auto* const curve = std::get_if<command::ExtendCurve>(&last);
    if (curve == nullptr || curve->points.empty() != more->points.empty()) return false;
    append(curve->vertices, more->vertices);
    append(curve->points, more->points);
    return true;
  }
  if (const auto* more = std::get_if<command::ExtendStroke>(&now)) {
    auto* const begun = std::get_if<command::Sculpt>(&last);
    append(begun != nullptr ? begun->stroke.points : std::get<command::ExtendStroke>(last).points,
           more->points);
    return true;
  }
  last = now;
  return true;
}

}  // namespace

bool CommandLog::add(const Command& command, const ViewerState& after) {
  std::optional<Command>* last = lines_.empty() ? nullptr : &lines_.back().command;
  const bool has_last = last != nullptr && last->has_value();
  if (has_last && moves_camera(**last) && moves_camera(command)) {
    *last = place_of(after.picture.camera);
    return true;
  }
  if (has_last && continues(**last, command) && merge(**last, command)) return true;
  lines_.push_back({command, {}});
  return false;
}

void CommandLog::fail_last_open() {
  const auto line = std::find_if(lines_.rbegin(), lines_.rend(), [](const Line& l) {
    return l.command && std::holds_alternative<command::Open>(*l.command);
  });
  if (line == lines_.rend()) return;
  line->comment = "did not open: " + to_text(*line->command);
  line->command.reset();
}

void CommandLog::fail_last_frame(bool all) {
  for (auto line = lines_.rbegin(); line != lines_.rend(); ++line) {
    if (!line->command) continue;
    const bool begins = std::holds_alternative<command::ShowSequence>(*line->command);
    const bool plays = all && std::holds_alternative<command::Play>(*line->command);
    if (!begins && !plays && !std::holds_alternative<command::ShowFrame>(*line->command)) continue;
    line->comment = "not shown: " + to_text(*line->command);
    line->command.reset();
    if (begins || !all) return;
  }
}

void CommandLog::drop_last(const Command& command) {
  const auto line = std::find_if(lines_.rbegin(), lines_.rend(), [&command](const Line& l) {
    return l.command && *l.command == command;
  });
  if (line != lines_.rend()) lines_.erase(std::next(line).base());
}

void CommandLog::add_comment(const std::string& text) { lines_.push_back({std::nullopt, text}); }

std::string CommandLog::last_line() const {
  if (lines_.empty()) return {};
  return lines_.back().command ? to_text(*lines_.back().command) : "# " + lines_.back().comment;
}

std::string CommandLog::script() const {
  std::string text;
  for (const Line& line : lines_) {
    text += (line.command ? to_text(*line.command) : "# " + line.comment) + '\n';
  }
  return text;
}

namespace {

Error bad(const std::string& path, const std::string& cause, const std::string& hint) {
  return {ErrorCode::kBadInput, one_line(path) + ": " + cause, {hint}};
}

/// Whether the file or one of the folders that the path names is hidden.
bool is_hidden(const fs::path& path) {
  return std::ranges::any_of(path, [](const fs::path& part) {
    return part.string().starts_with('.') && part != "." && part != "..";
  });
}

/// Extension and hidden names; `path` has no links in it, or they have been followed.
Result<void> check_name(const std::string& path, const Command& command) {
  if (is_hidden(path)) {
    return bad(path, "commands write no hidden files and nothing into hidden folders",
               "choose a path without names that begin with a dot");
  }
  if (std::holds_alternative<command::SaveDistances>(command)) {
    const bool of_space = check_tet_distances_path(path) || check_grid_distances_path(path);
    return of_space ? Result<void>() : check_distance_path(path);
  }
  if (std::holds_alternative<command::SaveMesh>(command)) return check_mesh_path(path);
  std::string what = "sessions and logs are", extension(kSessionExtension);
  if (std::holds_alternative<command::SavePicture>(command)) {
    for (const char* const known : {".png", ".pdf", ".svg"}) {
      if (io::file_extension(path) == known) return {};
    }
    return bad(path, "pictures are written as .png, .pdf or .svg", "name a FILE.png");
  }
  if (std::holds_alternative<command::SaveFigures>(command)) {
    what = "figures are";
    extension = ".json";
  }
  if (io::file_extension(path) == extension) return {};
  return bad(path, what + " written as " + extension, "name a FILE" + extension);
}

}  // namespace

const std::string* saved_path(const Command& command) {
  return std::visit(
      []<class Kind>(const Kind& c) -> const std::string* {
        constexpr bool kSaves =
            std::is_same_v<Kind, command::SavePicture> ||
            std::is_same_v<Kind, command::SaveDistances> ||
            std::is_same_v<Kind, command::SaveMesh> || std::is_same_v<Kind, command::SaveFigures> ||
            std::is_same_v<Kind, command::SaveSession> || std::is_same_v<Kind, command::SaveLog>;
        if constexpr (kSaves) return &c.path;
        return nullptr;
      },
      command);
}

Result<void> check_saved_name(const Command& command) {
  const std::string& path = *saved_path(command);
  if (path == "-") {
    return Error{
        ErrorCode::kBadInput, "a command writes files alone", {"give the name of one, not -"}};
  }
  if (auto checked = check_name(path, command); !checked) return checked;
  // From the current folder, which may itself lie in a hidden one.
  std::error_code unknown;
  const std::string target = fs::proximate(path, unknown).string();
  if (unknown) return {};  // Opening the file says what is wrong with its path.
  if (const auto checked = check_name(target, command); !checked) {
    return Error{ErrorCode::kBadInput,
                 one_line(path) + ": leads by a link to " + checked.error().message,
                 checked.error().hint};
  }
  return {};
}

Result<void> check_replaced_by_script(const Command& command) {
  const std::string& path = *saved_path(command);
  std::error_code unknown;
  if (!fs::exists(fs::symlink_status(path, unknown))) return {};
  return bad(path,
             "is there already, and a script replaces only files that it wrote itself in this run",
             "choose another name, or remove the file");
}

}  // namespace geotherm::app
