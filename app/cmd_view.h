// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/command_output.h"
#include "app/drawing.h"
#include "app/options.h"
#include "app/picture/picture_options.h"
#include "app/viewer_window.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct ViewArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  PictureArguments picture;
  std::string script;  ///< commands to run, in the window or without
  std::string replay;  ///< commands to run without a window and without writing files
  std::string output;  ///< the picture at the end, without a window
  bool headless = false;
  std::string scale;
  bool validation = false;
  bool quiet = false;
  std::string command;  ///< all that was typed, for the picture's file
};

void add_view_options(CLI::App& command, ViewArguments& arguments);

/// The commands that the options stand for. Errors: those of the options.
Result<std::vector<Command>> commands_of(const ViewArguments& arguments,
                                         std::span<const std::string> colour_maps);

/// Opens the window, or runs the commands without one where a replay, an output or --headless says
/// so. The output's text is then what the session has to say.
Result<CommandOutput> run_view(const ViewArguments& arguments, Drawing& drawing,
                               ViewerWindow& window, const Progress& progress = {});

}  // namespace geotherm::app
