// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace geotherm {

/// Threads that help one other thread, their owner, with passes over pieces of work. Each piece is
/// claimed by whoever is free, the owner included, which waits for nothing but pieces that a helper
/// has begun: a helper that the system does not run costs nothing. Who waits looks for work for
/// some microseconds, never gives the processor away meanwhile (beside busy processes it would come
/// back after milliseconds), and then sleeps.
class HelperThreads {
 public:
  /// How long a helper without work sleeps before its thread ends; the next pass starts another.
  static constexpr std::chrono::milliseconds kPatience{1000};
  explicit HelperThreads(std::chrono::milliseconds patience = kPatience) : patience_(patience) {}
  /// Not during a pass.
  ~HelperThreads();
  HelperThreads(const HelperThreads&) = delete;
  HelperThreads& operator=(const HelperThreads&) = delete;

  using Work = void (*)(void* context, int k, HelperThreads& team);
  /// Calls work(context, k, *this) for all k in [0, calls), 0 on this thread, with the help of up
  /// to `helpers` threads, and returns when all calls have ended. By one thread at a time, not from
  /// within a pass. `work` must not throw. Throws std::bad_alloc, before anything is called.
  void run(int calls, int helpers, void* context, Work work);

  /// Adds so many calls to the pass that is running, with the next numbers. For calls from within
  /// `work` alone.
  void call_more(int calls);

  /// Threads that have not ended for want of work.
  int alive();

 private:
  struct Helper {
    bool ended = false;  ///< under mutex_
    std::jthread thread;
  };

  void start(int count);
  void wake(int count);
  bool claim(std::uint64_t and_add);
  bool is_open() const;
  void work_on();
  void wait_for_others();
  void help(Helper& helper);
  bool sleep(Helper& helper);

  const std::chrono::milliseconds patience_;

  // The pass: written before its calls are offered, read by those who have claimed one.
  void* context_ = nullptr;
  Work work_ = nullptr;
  std::atomic<int> next_{0};  ///< number of the next call

  /// Calls that nobody has claimed, and helpers inside the pass times 2^32: 0 between passes.
  std::atomic<std::uint64_t> state_{0};
  std::atomic<int> sleepers_{0};
  std::atomic<bool> owner_sleeps_{false};
  std::atomic<bool> ends_{false};

  std::mutex mutex_;
  std::condition_variable work_there_, all_done_;
  std::vector<std::unique_ptr<Helper>> helpers_;  ///< last: they use all of the above
};

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
