// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "solver/core/helper_threads.h"

namespace geotherm {

/// Helpers that sleep between the calls that need them: one set for each thread that works at once.
/// A new thread may have to wait for milliseconds beside busy processes before it runs for the
/// first time; one that sleeps runs at once. Safe from several threads.
class HelperPool {
 public:
  /// Null where all are in use.
  std::unique_ptr<HelperThreads> take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return nullptr;
    auto out = std::move(free_.back());
    free_.pop_back();
    return out;
  }
  void give(std::unique_ptr<HelperThreads> helpers) {
    const std::lock_guard lock(mutex_);
    if (free_.size() < free_.capacity()) free_.push_back(std::move(helpers));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<HelperThreads>> free_ = with_room();  // so that give() never fails

  static std::vector<std::unique_ptr<HelperThreads>> with_room() {
    constexpr std::size_t kMax = 64;
    std::vector<std::unique_ptr<HelperThreads>> out;
    out.reserve(kMax);
    return out;
  }
};

/// Has the passes of parallel.h on the thread that makes it run on the same helpers, while it
/// lives, in place of a crew made before.
class ThreadCrew {
 public:
  /// `threads`: at most, the calling one included; with 1 every pass stays on this thread. Helpers
  /// start with the first pass that has work for them. They come from the pool and go back to it,
  /// or live as long as the crew; a pool must outlive it.
  explicit ThreadCrew(int threads, HelperPool* pool = nullptr);
  ~ThreadCrew();
  ThreadCrew(const ThreadCrew&) = delete;
  ThreadCrew& operator=(const ThreadCrew&) = delete;

  /// HelperThreads::run() with the helpers of this thread's crew, for up to `threads` threads in
  /// all; with helpers for this pass alone where the thread has no crew or is in a pass of it.
  static void run(int threads, int calls, void* context, HelperThreads::Work work);

 private:
  void run_pass(int threads, int calls, void* context, HelperThreads::Work work);

  const int threads_;
  HelperPool* const pool_;
  ThreadCrew* const before_;
  bool in_pass_ = false;
  std::unique_ptr<HelperThreads> helpers_;
};

}  // namespace geotherm
