// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/cli_app.h"
#include "app/command_output.h"
#include "geotherm/error.h"

namespace geotherm::app {

struct ListArguments {
  std::string json;
};

void add_backends_options(CLI::App& command, ListArguments& arguments);
void add_models_options(CLI::App& command, ListArguments& arguments);

/// Name and description of the backends of this build, one a line, the default first.
Result<CommandOutput> run_backends(const ListArguments& arguments);

/// Name, number of faces and description of the bundled models, one a line.
Result<CommandOutput> run_models(const ListArguments& arguments);

}  // namespace geotherm::app
