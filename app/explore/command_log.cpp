// SPDX-License-Identifier: MIT
#include "app/explore/command_log.h"

#include <algorithm>

#include "app/explore/apply.h"

namespace geotherm::app {
namespace {

bool moves_camera(const Command& command) {
  return std::holds_alternative<command::Orbit>(command) ||
         std::holds_alternative<command::Zoom>(command) ||
         std::holds_alternative<command::Pan>(command) ||
         std::holds_alternative<command::Place>(command);
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
  if (std::holds_alternative<command::ExtendCurve>(now)) {
    return std::holds_alternative<command::ExtendCurve>(before) ||
           std::holds_alternative<command::AddSources>(before);
  }
  return false;
}

bool CommandLog::add(const Command& command, const ViewerState& after) {
  std::optional<Command>* last = lines_.empty() ? nullptr : &lines_.back().command;
  const bool has_last = last != nullptr && last->has_value();
  if (has_last && moves_camera(**last) && moves_camera(command)) {
    *last = place_of(after.picture.camera);
    return true;
  }
  if (has_last && continues(**last, command)) {
    const auto* more = std::get_if<command::ExtendCurve>(&command);
    auto* const curve = std::get_if<command::ExtendCurve>(&**last);
    if (more == nullptr) {
      *last = command;
      return true;
    }
    if (curve != nullptr) {
      curve->vertices.insert(curve->vertices.end(), more->vertices.begin(), more->vertices.end());
      return true;
    }
  }
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

}  // namespace geotherm::app
