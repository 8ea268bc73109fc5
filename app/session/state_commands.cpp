// SPDX-License-Identifier: MIT
// From states back to commands, and which of them can be undone.
#include "app/session/command.h"
#include "app/session/settings.h"

namespace geotherm::app {
namespace {

/// Adds the commands that make these settings equal, one by one.
void add_settings(ViewerState& from, const ViewerState& to, std::vector<Command>& commands) {
  for (const Setting& setting : settings()) {
    const std::string wanted = setting.get(to);
    if (setting.get(from) == wanted) continue;
    commands.emplace_back(command::Set{std::string(setting.name), wanted});
    [[maybe_unused]] const auto set = setting.set(from, wanted);
  }
}

}  // namespace

std::vector<Command> commands_to(const ViewerState& state) {
  std::vector<Command> commands;
  ViewerState now = initial_state();
  if (!state.model.empty()) {
    commands.emplace_back(command::Open{state.model});
    now = *app::apply(now, commands.back());
  }
  if (!state.field.empty()) commands.emplace_back(command::ShowField{state.field});
  if (state.kept) {
    ViewerState kept = now;
    kept.options = *state.kept;
    add_settings(now, kept, commands);
    commands.emplace_back(command::Keep{});
  }
  add_settings(now, state, commands);
  const Timeline& timeline = state.timeline;
  if (!timeline.sequence.empty()) commands.emplace_back(command::ShowSequence{timeline.sequence});
  if (timeline.frame > 0) commands.emplace_back(command::ShowFrame{timeline.frame});
  if (!timeline.loop) commands.emplace_back(command::Loop{false});
  for (const auto& stroke : state.sculpture.strokes) {
    commands.emplace_back(command::Sculpt{*stroke});
  }
  // After the method: not every method takes every source.
  if (now.sources != state.sources) {
    if (state.sources.empty()) {
      commands.emplace_back(command::ClearSources{});
    } else {
      commands.emplace_back(command::SetSources{state.sources});
    }
  }
  if (state.max_distance < kUnreached) {
    commands.emplace_back(command::MaxDistance{state.max_distance});
  }
  if (state.shown != Shown::kA) commands.emplace_back(command::Show{state.shown});
  if (state.target) commands.emplace_back(command::Target{state.target});
  if (state.centre) commands.emplace_back(command::ShowCentre{state.centre});
  if (state.picked) commands.emplace_back(command::Pick{state.picked});
  if (timeline.playing) commands.emplace_back(command::Play{true});
  if (state.rotating) commands.emplace_back(command::Rotate{true});
  return commands;
}

UndoRule undo_rule(const Command& command) {
  if (const auto* set = std::get_if<command::Set>(&command)) {
    const Setting* const setting = find_setting(set->name);
    if (setting != nullptr && setting->group == SettingGroup::kCamera) return {};
    const bool slider =
        set->name == "time-factor" || set->name == "slice-at" || set->name == "peel";
    return {true, slider};
  }
  const bool merged =
      is_any_of<command::MoveSource, command::ExtendCurve, command::ExtendStroke>(command);
  const bool undoable =
      merged || is_any_of<command::SetSources, command::AddSources, command::RemoveSource,
                          command::ClearSources, command::MoreSources, command::FewerSources,
                          command::ShuffleSources, command::Sculpt, command::Keep, command::Forget,
                          command::Swap, command::Show, command::Flip, command::Target,
                          command::ShowCentre, command::ShowField, command::MaxDistance>(command);
  return {undoable, merged};
}

}  // namespace geotherm::app
