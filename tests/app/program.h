// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {

/// What a run of the built program left.
struct ProgramRun {
  int code = -1;  ///< exit code; 128 + signal where one ended it
  std::string out, err;
};

/// Where standard output goes instead of into ProgramRun::out.
enum class Stdout { kCaptured, kFull, kClosed, kPipeWithoutReader };

/// The program while it runs in `folder`. After `seconds` (0: never) a signal ends it. Its standard
/// input is the file `input`, and empty without one.
class RunningProgram {
 public:
  RunningProgram(const std::string& folder, const std::vector<std::string>& arguments,
                 Stdout output = Stdout::kCaptured, unsigned seconds = 0,
                 const std::string& input = {});

  void signal(int number) const;
  ProgramRun wait() const;  ///< once

 private:
  TemporaryDirectory streams_;
  Stdout output_;
  int process_ = -1;
};

/// Runs the program in `folder` and waits for it.
ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       Stdout output = Stdout::kCaptured, unsigned seconds = 0,
                       const std::string& input = {});

}  // namespace geotherm::test
