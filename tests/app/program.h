// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::test {

/// What a run of the built program left.
struct ProgramRun {
  int code = -1;  ///< exit code; 128 + signal where one ended it
  std::string out, err;
};

/// Where standard output goes instead of into ProgramRun::out.
enum class Stdout { kCaptured, kFull, kClosed, kPipeWithoutReader };

/// Runs the program in `folder` and waits for it.
ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       Stdout output = Stdout::kCaptured);

}  // namespace geotherm::test
