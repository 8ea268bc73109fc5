// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/cli_app.h"
#include "app/outputs.h"
#include "app/settings_options.h"
#include "app/source_spec.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// Where distance is 0, as typed.
struct SourceArguments {
  std::vector<std::string> sources;
  std::string file;
  bool curve = false;
};

/// The model as a word of its own, and how it is read.
CLI::Option* add_model_option(CLI::App& command, std::string& model, SettingArguments& settings);
void add_source_options(CLI::App& command, SourceArguments& arguments);
void add_quiet_option(CLI::App& command, bool& quiet);

/// The files that these name, which no output may replace.
void protect_inputs(const std::string& model, const SourceArguments& sources, Outputs& outputs);

/// The sources of a command that cannot do without. Errors: those of sources_of(), kBadInput
/// (none).
Result<std::vector<Source>> some_sources_of(const SourceArguments& arguments);

/// All sources that were named; none is no error here. Errors: kBadInput, kBadFile.
Result<std::vector<Source>> sources_of(const SourceArguments& arguments);

}  // namespace geotherm::app
