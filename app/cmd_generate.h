// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/cli_app.h"
#include "app/command_output.h"
#include "geotherm/error.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct GenerateArguments {
  std::string name;
  std::string faces;  ///< empty: the model's usual size
  std::string output;
  bool quiet = false;
};

void add_generate_options(CLI::App& command, GenerateArguments& arguments);
Result<CommandOutput> run_generate(const GenerateArguments& arguments,
                                   const Progress& progress = {});

}  // namespace geotherm::app
