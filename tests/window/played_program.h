// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {

/// For whatever a slow and busy machine may take.
inline constexpr std::chrono::seconds kPatience{30};

/// Asks again and again, for kPatience at most, whether it is so.
bool eventually(const std::function<bool()>& so);

/// The built program while it runs. What it does is seen in the processor time it has used: it
/// draws when something happens and sleeps otherwise.
class PlayedProgram {
 public:
  /// Starts it in `folder`. Throws std::runtime_error where that fails.
  PlayedProgram(const std::string& folder, const std::vector<std::string>& arguments);
  PlayedProgram(const PlayedProgram&) = delete;
  PlayedProgram& operator=(const PlayedProgram&) = delete;
  /// Ends it if it still runs.
  ~PlayedProgram();

  bool runs();
  pid_t process() const { return process_; }
  /// Waits until it has ended by itself. Code -1: it has not.
  ProgramRun end();

  /// Processor time used so far, clock ticks.
  long ticks() const;
  /// Until it has used so much more than `before`: it has taken notice of what came then.
  bool notice(long before, long more);
  /// Until it sleeps.
  bool rest();

 private:
  TemporaryDirectory streams_;
  pid_t process_ = 0;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace geotherm::test
