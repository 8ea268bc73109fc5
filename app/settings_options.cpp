// SPDX-License-Identifier: MIT
#include "app/settings_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/explore/apply.h"
#include "app/text.h"
#include "app/told.h"

namespace geotherm::app {
namespace {

const char* heading_of(SettingGroup group) {
  switch (group) {
    case SettingGroup::kModel:
      return "Model";
    case SettingGroup::kMethod:
      return "Method";
    case SettingGroup::kCheck:
      return "Accuracy";
    case SettingGroup::kPicture:
      return "Picture";
    case SettingGroup::kCamera:
      return "Camera";
  }
  return "";
}

std::string spelling_of(const Setting& setting) {
  if (!setting.option.empty()) return std::string(setting.option);
  return "--" + std::string(setting.name);
}

/// The phrase, the values there are, and what holds where the option is left out.
std::string help_of(const Setting& setting, const ViewerState& state) {
  const std::string help(setting.help);
  if (!setting.bare.empty()) return setting.bare == "off" ? "without " + help : help;
  if (!setting.forms.empty()) return help + ": " + std::string(setting.forms);
  const std::string usual = setting.get(state);
  if (setting.values == nullptr) return help + ", default " + usual;
  std::vector<std::string> values = setting.values();
  for (std::string& value : values) {
    if (value == usual) value += " (default)";
  }
  return help + ": " + joined(values);
}

}  // namespace

std::vector<std::string_view> names_of(SettingGroup group, std::vector<std::string_view> without) {
  std::vector<std::string_view> names;
  for (const Setting& setting : settings()) {
    if (setting.group != group || std::ranges::count(without, setting.name) > 0) continue;
    names.push_back(setting.name);
  }
  return names;
}

void add_setting_options(CLI::App& command, SettingArguments& arguments,
                         const std::vector<std::string_view>& names) {
  const ViewerState usual = usual_settings();
  for (const std::string_view name : names) {
    const Setting& setting = *find_setting(name);
    const auto take = [&arguments, name](const std::string& text) {
      arguments.texts[std::string(name)] = text;
    };
    CLI::Option* const option =
        setting.bare.empty()
            ? command
                  .add_option_function<std::string>(spelling_of(setting), take,
                                                    help_of(setting, usual))
                  ->type_name(std::string(setting.value_name))
            : command.add_flag_callback(
                  spelling_of(setting), [take, bare = std::string(setting.bare)] { take(bare); },
                  help_of(setting, usual));
    option->group(heading_of(setting.group));
  }
}

ViewerState usual_settings() {
  ViewerState state = initial_state();
  state.picture = {};
  return state;
}

Result<ViewerState> settings_in(const SettingArguments& arguments) {
  ViewerState state = usual_settings();
  for (const Setting& setting : settings()) {
    const auto typed = arguments.texts.find(setting.name);
    if (typed == arguments.texts.end()) continue;
    const auto set = setting.set(state, typed->second);
    if (!set) {
      return about("--" + std::string(setting.name), set.error());
    }
  }
  return state;
}

void note_unused_settings(const SettingArguments& arguments, const MethodOptions& options,
                          std::vector<std::string>& warnings) {
  if (options.method != MethodKind::kHeat) {
    const ViewerState usual = usual_settings();
    std::vector<std::string> unused;
    for (const Setting& setting : settings()) {
      const auto typed = arguments.texts.find(setting.name);
      if (!setting.of_heat || typed == arguments.texts.end()) continue;
      if (typed->second != setting.get(usual)) unused.push_back("--" + std::string(setting.name));
    }
    if (unused.empty()) return;
    warnings.push_back("the method " + to_text(options.method) + " does not use " + joined(unused) +
                       "; these are options of --method heat");
    return;
  }
  const auto factor = arguments.texts.find("time-factor");
  if (options.time_step.rule != TimeRule::kAbsolute || factor == arguments.texts.end()) return;
  warnings.push_back("--time-factor " + factor->second + " is not used: --time-step " +
                     arguments.texts.find("time-step")->second +
                     " is the time itself; leave one of them out");
}

}  // namespace geotherm::app
