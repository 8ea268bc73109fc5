// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/cli_app.h"
#include "app/command_output.h"
#include "app/drawing.h"

namespace geotherm::app {

struct DevicesArguments {
  std::string json;
};

void add_devices_options(CLI::App& command, DevicesArguments& arguments);

/// What can draw on this machine, one a line, the default marked; what cannot says why. Errors:
/// kNoDevice when there is none at all, those of the JSON file.
Result<CommandOutput> run_devices(const DevicesArguments& arguments, Drawing& drawing);

}  // namespace geotherm::app
