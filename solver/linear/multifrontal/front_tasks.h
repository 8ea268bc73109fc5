// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "solver/core/parallel.h"
#include "solver/core/processor.h"
#include "solver/linear/multifrontal/front_tree.h"

namespace geotherm {

/// Divides the tree into tasks, and measures the memory that they need for data that waits within
/// and between them. The division depends on the tree alone, or is that of an `earlier` tree where
/// that has the same nodes.
void divide_into_tasks(FrontTree& tree, const FrontTree* earlier = nullptr);

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

/// Hands tasks to threads. A task is ready once those before it are done: its children when going
/// up, its parent when going down. No thread blocks here: one that finds no ready task leaves, and
/// one that makes several tasks ready calls others.
class TaskQueue {
 public:
  enum class Direction { kUp, kDown };
  /// `threads`: that may have a task at a time.
  TaskQueue(const std::vector<FrontTask>& tasks, Direction direction, int threads);

  /// The next task, kNoIndex when none is ready or stop() was called. `done`: the one before;
  /// kNoIndex for a thread that comes, which is held to the number of threads. `others`: how many
  /// threads more there would be tasks for since then.
  Index next(Index done, int& others);
  void stop();
  /// Tasks that are ready before any is done.
  int ready() const { return static_cast<int>(ready_.size()); }

 private:
  const std::vector<FrontTask>& tasks_;
  const Direction direction_;
  const int threads_;
  std::mutex mutex_;
  std::vector<Index> waits_for_;  ///< per task
  std::vector<Index> ready_;      ///< the last one goes first
  int at_work_ = 0;
  bool stopped_ = false;
};

/// Keeps the workers of threads that come and go, so that there are never more of them than threads
/// at the same time.
template <class Worker>
class WorkerShelf {
 public:
  template <class Make>
  std::unique_ptr<Worker> take(const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (!shelf_.empty()) {
        auto out = std::move(shelf_.back());
        shelf_.pop_back();
        return out;
      }
    }
    return std::make_unique<Worker>(make());
  }
  void give(std::unique_ptr<Worker> worker) {
    const std::lock_guard lock(mutex_);
    shelf_.push_back(std::move(worker));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> shelf_;
};

/// Calls work(task, number, worker) for every task, on up to `threads` threads; make_worker() makes
/// what a thread keeps for itself; denormals are flushed within. `work` returns false to stop
/// everything. Exceptions are rethrown.
template <class MakeWorker, class Work>
void run_tasks(const FrontTree& tree, TaskQueue::Direction direction, int threads,
               const MakeWorker& make_worker, const Work& work) {
  const auto count = static_cast<Index>(tree.tasks.size());
  if (threads <= 1 || count <= 1) {
    const FlushDenormals flush;
    auto worker = make_worker();
    for (Index k = 0; k < count; ++k) {
      const Index task = direction == TaskQueue::Direction::kUp ? k : count - 1 - k;
      if (!work(tree.tasks[task], task, worker)) return;
    }
    return;
  }
  TaskQueue queue(tree.tasks, direction, threads);
  WorkerShelf<decltype(make_worker())> shelf;
  SharedFailure failure;
  run_team(threads, std::min(threads, queue.ready()), [&](int, HelperThreads& team) noexcept {
    try {
      int others = 0;
      Index task = queue.next(kNoIndex, others);
      if (task == kNoIndex) return;
      const FlushDenormals flush;
      auto worker = shelf.take(make_worker);
      for (; task != kNoIndex; task = queue.next(task, others)) {
        team.call_more(others);
        if (!work(tree.tasks[task], task, *worker)) queue.stop();
      }
      shelf.give(std::move(worker));
    } catch (...) {
      failure.keep(std::current_exception());
      queue.stop();
    }
  });
  failure.rethrow();
}

}  // namespace geotherm
