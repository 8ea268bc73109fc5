// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/command_output.h"
#include "app/options.h"
#include "solver/core/progress.h"

namespace geotherm::app {

struct SolveArguments {
  std::string model;
  ReadingArguments reading;
  SourceArguments sources;
  MethodArguments method;
  std::vector<std::string> outputs;
  std::string json;
  bool check = false;   ///< against a more accurate method
  std::string fields;   ///< quality fields beside the distances, empty: none
  bool labels = false;  ///< nearest sources in .csv and .npy, too
  bool quiet = false;
};

void add_solve_options(CLI::App& command, SolveArguments& arguments);
Result<CommandOutput> run_solve(const SolveArguments& arguments, const Progress& progress = {});

}  // namespace geotherm::app
