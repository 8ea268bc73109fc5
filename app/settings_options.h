// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli_app.h"
#include "app/explore/settings.h"
#include "geotherm/error.h"

// The table of settings on the command line.
namespace geotherm::app {

/// Settings as typed: texts by name.
struct SettingArguments {
  std::map<std::string, std::string, std::less<>> texts;

  bool has(std::string_view name) const { return texts.contains(name); }
};

/// The names of a group's settings, but for some.
std::vector<std::string_view> names_of(SettingGroup group,
                                       std::vector<std::string_view> without = {});

/// An option for each of these settings, under the heading of its group.
void add_setting_options(CLI::App& command, SettingArguments& arguments,
                         const std::vector<std::string_view>& names);

/// What a command begins with where nothing is typed.
ViewerState usual_settings();

/// Those with what was typed. Errors: kBadInput or kNotAvailable, with the option's name and what
/// is expected.
Result<ViewerState> settings_in(const SettingArguments& arguments);

/// Says which of the typed settings of methods have no effect beside the others.
void note_unused_settings(const SettingArguments& arguments, const MethodOptions& options,
                          std::vector<std::string>& warnings);

}  // namespace geotherm::app
