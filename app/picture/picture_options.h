// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli_app.h"
#include "app/picture/picture_settings.h"
#include "app/settings_options.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// What a picture needs beside the settings of the table, as typed.
struct PictureArguments {
  std::string turntable;  ///< empty: one picture
  std::string device;
};

void add_picture_options(CLI::App& command, SettingArguments& settings,
                         PictureArguments& arguments);

/// `--fit` may stand alone, and CLI11 would then take the next word for its value: a bare one
/// becomes `--fit=tight`.
void complete_bare_fit(std::vector<std::string>& words);

/// `asked`: settings_in() of what was typed, `typed`; `colour_maps`: the names there are, the
/// default first. Errors: kBadInput, with the option's
/// name, the value and what is expected.
Result<PictureSettings> picture_settings(const ViewerState& asked, const SettingArguments& typed,
                                         const PictureArguments& arguments,
                                         std::span<const std::string> colour_maps);

/// Those of the options that a picture of lines has, too, .svg.
void add_line_picture_options(CLI::App& command, SettingArguments& settings);

}  // namespace geotherm::app
