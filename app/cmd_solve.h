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

struct SolveArguments {
  std::string model;
  SettingArguments settings;
  SourceArguments sources;
  std::vector<std::string> outputs;
  std::string json;
  CheckArguments check;
  std::string fields;      ///< quality fields beside the distances, empty: none
  bool labels = false;     ///< nearest sources in .csv and .npy, too
  bool each = false;       ///< a row of distances for each source
  bool pairs = false;      ///< distances between the sources alone
  bool symmetric = false;  ///< of pairs: the mean of both directions
  std::string dtype;       ///< of .npy rows; empty: float64
  bool float32 = false;    ///< the same as --dtype float32
  bool quiet = false;
};

void add_solve_options(CLI::App& command, SolveArguments& arguments);
/// `announce`: for what --each and --pairs say before their work.
Result<CommandOutput> run_solve(const SolveArguments& arguments, const Progress& progress = {},
                                const Announce& announce = {});

}  // namespace geotherm::app
