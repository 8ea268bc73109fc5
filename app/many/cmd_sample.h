// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/announce.h"
#include "app/check_options.h"
#include "app/command_output.h"
#include "app/options.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct SampleArguments {
  std::string model;
  SettingArguments settings;
  std::string count;
  std::string first;                 ///< a vertex id; empty: chosen by the program
  std::vector<std::string> outputs;  ///< distances and labels of every vertex
  std::string samples;               ///< where the list of samples goes
  std::string json;
  CheckArguments check;
  bool quiet = false;
};

void add_sample_options(CLI::App& command, SampleArguments& arguments);
Result<CommandOutput> run_sample(const SampleArguments& arguments, const Progress& progress = {},
                                 const Announce& announce = {});

}  // namespace geotherm::app
