// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/cli_app.h"
#include "app/command_output.h"
#include "app/settings_options.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct InfoArguments {
  std::string model;
  SettingArguments settings;
  std::string json;
  bool quiet = false;
};

void add_info_options(CLI::App& command, InfoArguments& arguments);
Result<CommandOutput> run_info(const InfoArguments& arguments, const Progress& progress = {});

}  // namespace geotherm::app
