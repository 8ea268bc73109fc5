// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/check_options.h"
#include "app/command_output.h"
#include "app/lines/line_files.h"
#include "app/options.h"

namespace geotherm::app {

struct IsolinesArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  std::string spacing, count;  ///< one of them is given
  LineFileArguments files;
  CheckArguments check;
  bool quiet = false;
};

void add_isolines_options(CLI::App& command, IsolinesArguments& arguments);
Result<CommandOutput> run_isolines(const IsolinesArguments& arguments,
                                   const Progress& progress = {});

}  // namespace geotherm::app
