// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace geotherm {

/// Helpers for many short passes in a row. A thread takes some 50 us to start, longer than a pass
/// over a hundred thousand rows: while a crew lives, the passes of parallel.h on its thread run on
/// helpers that are there already. They watch for the next pass for a while before they sleep.
class ThreadCrew {
 public:
  /// `threads`: at most, the calling one included. Helpers start with the first pass that has work
  /// for them. The crew serves the thread that makes it, in place of one made before, until it ends
  /// there.
  explicit ThreadCrew(int threads);
  ~ThreadCrew();
  ThreadCrew(const ThreadCrew&) = delete;
  ThreadCrew& operator=(const ThreadCrew&) = delete;

  using Work = void (*)(void* context, int k);
  /// Calls work(context, k) for all k in [0, count), 0 on this thread, and returns when all have
  /// ended; for more parts than threads this one does the rest. False, and nothing is called, where
  /// this thread has no crew or is in a pass of its crew's. `work` must not throw. Throws
  /// std::bad_alloc, before anything is called.
  static bool run(int count, void* context, Work work);

 private:
  struct Helper {
    std::atomic<unsigned> passes{0};  ///< that it was called to
    std::jthread thread;              ///< last: it uses the other until it ends
  };

  void run_pass(int count, void* context, Work work);
  void start_helpers(int count);
  void help(int k, Helper& helper);

  const int threads_;
  ThreadCrew* const before_;
  bool in_pass_ = false;
  bool no_more_ = false;  ///< the system has no more threads

  // The pass: written before helpers are called to it.
  void* context_ = nullptr;
  Work work_ = nullptr;
  bool ends_ = false;
  std::atomic<int> at_work_{0};  ///< helpers that have not ended it

  std::vector<std::unique_ptr<Helper>> helpers_;  ///< last, for the same reason
};

}  // namespace geotherm
