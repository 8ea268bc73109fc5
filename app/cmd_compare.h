// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/command_output.h"
#include "app/options.h"
#include "geotherm/progress.h"

namespace geotherm::app {

struct CompareArguments {
  std::vector<std::string> models;
  SettingArguments settings;
  std::string backends = "all";
  std::string queries = "10";
  std::string reference;  ///< empty: the first of the backends
  SourceArguments sources;
  std::string json, csv, html;
  bool quiet = false;
};

void add_compare_options(CLI::App& command, CompareArguments& arguments);
Result<CommandOutput> run_compare(const CompareArguments& arguments, const Progress& progress = {});

}  // namespace geotherm::app
