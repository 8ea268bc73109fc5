// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <mutex>
#include <string>

#include "tests/explore/session_fixture.h"
#include "tests/support/sanitized.h"

namespace geotherm::app {

/// A session with threads for its work, beside one without.
class SessionThread : public SessionFixture {
 protected:
  SessionThread()
      : threaded([this] {
          SessionHooks hooks;
          hooks.wake = [this] {
            ++wakes;
            const std::lock_guard waits(gate);
          };
          return hooks;
        }()) {}

  /// So large that the work goes on when it is cancelled; with a sanitizer the small one takes long
  /// enough.
  std::string slow_model() { return test::kSanitized ? small_model() : "terrain"; }

  std::atomic<int> wakes = 0;
  std::mutex gate;  ///< while a test holds it, workers wait where a stage begins
  Session threaded;
};

}  // namespace geotherm::app
