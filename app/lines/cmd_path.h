// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/check_options.h"
#include "app/command_output.h"
#include "app/lines/line_files.h"
#include "app/options.h"

namespace geotherm::app {

struct PathArguments {
  std::string model;
  SettingArguments settings;
  std::string from;
  std::vector<std::string> to, via;
  std::string field = "geodesic";
  bool closed = false, hold = false;
  LineFileArguments files;
  CheckArguments check;
  bool quiet = false;
};

void add_path_options(CLI::App& command, PathArguments& arguments);
Result<CommandOutput> run_path(const PathArguments& arguments, const Progress& progress = {});

}  // namespace geotherm::app
