// SPDX-License-Identifier: MIT
#include "app/check_options.h"

#include <CLI/CLI.hpp>

#include "app/text.h"

namespace geotherm::app {

void add_check_options(CLI::App& command, CheckArguments& arguments) {
  add_no_check_option(command, arguments);
  command
      .add_option("--on-poor", arguments.on_poor,
                  "what becomes of poor distances: keep (default: a warning), better (the first of "
                  "wavefront, wavefront-fine, exact that is right answers instead), fail (exit "
                  "code 1, nothing is written)")
      ->type_name("WHAT")
      ->group("Accuracy");
}

void add_no_check_option(CLI::App& command, CheckArguments& arguments) {
  command
      .add_flag("--no-check", arguments.no_check,
                "heat distances are not held against near-exact ones, which is done otherwise")
      ->group("Accuracy");
}

Result<CheckSettings> check_settings(const CheckArguments& arguments) {
  CheckSettings settings;
  if (arguments.on_poor == "better") {
    settings.on_poor = OnPoor::kBetter;
  } else if (arguments.on_poor == "fail") {
    settings.on_poor = OnPoor::kFail;
  } else if (!arguments.on_poor.empty() && arguments.on_poor != "keep") {
    return Error{ErrorCode::kBadInput,
                 "--on-poor: '" + one_line(arguments.on_poor) + "' is none of keep, better, fail"};
  }
  if (arguments.no_check && arguments.check) {
    return Error{ErrorCode::kBadInput,
                 "--check and --no-check were both given; leave one of them out"};
  }
  if (arguments.no_check && settings.on_poor != OnPoor::kKeep) {
    return Error{ErrorCode::kBadInput,
                 "--on-poor " + arguments.on_poor + " needs the check; leave --no-check out"};
  }
  if (arguments.check) settings.mode = CheckMode::kThorough;
  if (arguments.no_check) settings.mode = CheckMode::kNone;
  return settings;
}

std::string accuracy_note(const std::string& json, const Outputs& outputs, bool quiet,
                          const AccuracyReport& report, const std::string& line) {
  if (quiet || !outputs.uses_stdout() || json == "-") return {};
  if (!report.measured || report.is_poor()) return {};
  return "accuracy: " + line;
}

}  // namespace geotherm::app
