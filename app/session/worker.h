// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "geotherm/progress.h"

namespace geotherm::app {

/// A thread that does one job at a time. Of the jobs that wait only the latest is kept. It gives
/// way to other threads where the machine is busy, so that frames come first.
class Worker {
 public:
  /// Asked to stop, a job sees its progress return false. Must not throw.
  using Job = std::function<void(const Progress& progress)>;

  /// `changed` is called, from the worker's thread, when busy() or stage() may have changed.
  explicit Worker(std::function<void()> changed);
  /// Cancels and waits.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Replaces what waits. `cancel_running`: what runs now is asked to stop.
  void start(Job job, bool cancel_running);
  void cancel();  ///< what runs, and what waits
  void wait();    ///< until nothing runs or waits

  struct Status {
    bool busy = false;
    std::string stage;
    double share = -1;  ///< negative: unknown
  };
  Status status() const;

 private:
  void work(const std::stop_token& stop);
  bool take_progress(std::string_view stage, double share);

  std::function<void()> changed_;
  mutable std::mutex mutex_;
  std::condition_variable_any work_there_, idle_;
  Job waiting_;
  bool running_ = false, cancelled_ = false;
  std::string stage_;
  double share_ = -1;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace geotherm::app
