// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <vector>

#include "solver/core/flush_denormals.h"
#include "solver/core/parallel.h"
#include "solver/linear/front_tree.h"

namespace geotherm {

/// Fills the tasks of the tree and how much waits within and between them. The division depends on
/// the tree alone.
void divide_into_tasks(FrontTree& tree);

/// The first exception of several threads.
class SharedFailure {
 public:
  void keep(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// Hands tasks out to threads, each once all those it waits for are done: its children when going
/// up, its parent when going down.
class TaskQueue {
 public:
  enum class Direction { kUp, kDown };
  TaskQueue(const std::vector<FrontTask>& tasks, Direction direction);

  /// The next task; kNoIndex when all are done or stop() was called. `done`: the one before.
  Index next(Index done);
  void stop();

 private:
  const std::vector<FrontTask>& tasks_;
  Direction direction_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Index> waits_for_;  ///< per task
  std::vector<Index> ready_;      ///< the last one goes first
  std::size_t finished_ = 0;
  bool stopped_ = false;
  std::atomic<unsigned> changes_{0};  ///< of what next() waits for
};

/// Calls work(task, worker) for every task, on up to `threads` threads; make_worker() makes what a
/// thread keeps for itself; denormals are flushed within. `work` returns false to stop everything.
/// Exceptions are rethrown.
template <class MakeWorker, class Work>
void run_tasks(const FrontTree& tree, TaskQueue::Direction direction, int threads,
               const MakeWorker& make_worker, const Work& work) {
  TaskQueue queue(tree.tasks, direction);
  SharedFailure failure;
  const auto most = std::min<std::size_t>(static_cast<std::size_t>(threads), tree.tasks.size());
  run_on_threads(static_cast<int>(most), [&](int) noexcept {
    try {
      const FlushDenormals flush;
      auto worker = make_worker();
      for (Index task = queue.next(kNoIndex); task != kNoIndex; task = queue.next(task)) {
        if (!work(tree.tasks[task], task, worker)) return queue.stop();
      }
    } catch (...) {
      failure.keep(std::current_exception());
      queue.stop();
    }
  });
  failure.rethrow();
}

}  // namespace geotherm
