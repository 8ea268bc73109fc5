// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/answer_check.h"
#include "app/cli_app.h"
#include "app/outputs.h"

namespace geotherm::app {

/// How distances are to be checked, as typed.
struct CheckArguments {
  bool check = false;
  bool no_check = false;
  std::string on_poor;  ///< empty: keep
};

/// --no-check and --on-poor.
void add_check_options(CLI::App& command, CheckArguments& arguments);
void add_no_check_option(CLI::App& command, CheckArguments& arguments);

/// Errors: kBadInput (options that contradict each other, a word that is none).
Result<CheckSettings> check_settings(const CheckArguments& arguments);

/// How right the distances are, for standard error where it is nowhere on standard output; empty:
/// it is there, nobody wants it, or a warning says it. `json`: where the JSON goes; `line`:
/// accuracy_line().
std::string accuracy_note(const std::string& json, const Outputs& outputs, bool quiet,
                          const AccuracyReport& report, const std::string& line);

}  // namespace geotherm::app
