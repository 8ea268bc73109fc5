// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/command_output.h"
#include "app/options.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct StudyArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  std::string factors = "0.1:100:13";
  std::string json, svg;
  bool quiet = false;
};

void add_study_options(CLI::App& command, StudyArguments& arguments);
Result<CommandOutput> run_study(const StudyArguments& arguments, const Progress& progress = {});

}  // namespace geotherm::app
