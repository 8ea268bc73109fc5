// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/check_options.h"
#include "app/command_output.h"
#include "app/drawing.h"
#include "app/options.h"
#include "app/picture/picture_options.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct RenderArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  PictureArguments picture;
  CheckArguments check;
  std::vector<std::string> targets;  ///< paths lead there from the sources
  std::string output;
  std::string json;
  bool quiet = false;
  std::string command;  ///< all that was typed, for the picture's file
};

void add_render_options(CLI::App& command, RenderArguments& arguments);

/// Pictures of a model, solved first where sources are given. Opens the device before it reads the
/// model; leaves no frame behind when one fails. Errors: those of the options, the drawing, the
/// solve and the files.
Result<CommandOutput> run_render(const RenderArguments& arguments, Drawing& drawing,
                                 const Progress& progress = {});

}  // namespace geotherm::app
