// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/cli/cli_app.h"
#include "app/cli/options.h"
#include "app/picture/line_picture.h"
#include "app/session/model.h"
#include "app/session/outputs.h"
#include "geotherm/path.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// Where the lines of a command go, as typed.
struct LineFileArguments {
  std::vector<std::string> outputs;
  std::string json;
};

/// `what`: "the path", for the help.
void add_line_file_options(CLI::App& command, LineFileArguments& arguments,
                           SettingArguments& settings, const std::string& what);

/// Errors: kBadInput and kNotAvailable (an ending, a picture's option), those of Outputs::expect().
Result<void> expect_line_files(const LineFileArguments& arguments, Outputs& outputs);

/// A picture of the model without lines, titled with its name and `what` is to be shown.
LinePicture picture_on(const Model& model, const std::string& what);

/// Writes the lines to every output; "-" is CSV, which the output's text takes. Warns of pictures
/// that show none of them.
/// Errors: kBadFile, kCancelled, those of line_picture_svg().
Result<void> write_line_files(const LineFileArguments& arguments, const LinePicture& picture,
                              const PictureSettings& settings, const Progress& progress,
                              Outputs& outputs, CommandOutput& out);

}  // namespace geotherm::app
