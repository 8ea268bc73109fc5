// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace geotherm {

/// Helpers for many short passes in a row. A thread takes some 50 us to start, longer than a pass
/// over a hundred thousand rows: while a crew lives, the passes of parallel.h on its thread run on
/// helpers that are there already. They watch for the next pass for a while before they sleep.
class ThreadCrew {
 public:
  /// `threads`: in all, the calling one included. Helpers start with the first pass. The crew
  /// serves the thread that makes it, in place of one made before, until it ends there.
  explicit ThreadCrew(int threads);
  ~ThreadCrew();
  ThreadCrew(const ThreadCrew&) = delete;
  ThreadCrew& operator=(const ThreadCrew&) = delete;

  using Work = void (*)(void* context, int k);
  /// Calls work(context, k) for all k in [0, count), 0 on this thread, and returns when all have
  /// ended. False, and nothing is called, where this thread has no crew or is in a pass of its
  /// crew's. `work` must not throw. Throws std::bad_alloc, before anything is called.
  static bool run(int count, void* context, Work work);

 private:
  void run_pass(int count, void* context, Work work);
  void start_helpers();
  void help(int k);

  const int threads_;
  ThreadCrew* const before_;
  bool in_pass_ = false;

  // The pass: written before `pass_` goes up.
  void* context_ = nullptr;
  Work work_ = nullptr;
  int shared_ = 0;  ///< of its parts, that helpers do
  bool ends_ = false;
  std::atomic<unsigned> pass_{0};
  std::atomic<int> at_work_{0};  ///< helpers that have not ended it

  std::vector<std::jthread> helpers_;  ///< last: they use the others until they end
};

}  // namespace geotherm
