// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <exception>
#include <mutex>
#include <string_view>
#include <utility>

#include "geotherm/progress.h"

namespace geotherm {

/// A progress for work on several threads: passes calls on one at a time, with shares that never
/// fall, and none after the first that said stop or threw. An exception does not pass through the
/// work, whose threads could not hand it on: it is kept for rethrow().
class SharedProgress {
 public:
  /// Keeps a reference.
  explicit SharedProgress(const Progress& progress) : progress_(progress) {}
  explicit SharedProgress(Progress&& progress) = delete;

  bool operator()(std::string_view stage, double share) {
    const std::lock_guard lock(mutex_);
    if (stopped_) return false;
    if (share >= 0) share = most_ = std::max(most_, share);
    try {
      stopped_ = !report(progress_, stage, share);
    } catch (...) {
      thrown_ = std::current_exception();
      stopped_ = true;
    }
    return !stopped_;
  }

  /// Makes every later call say stop.
  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }

  /// Throws what the progress has thrown. To be called once the work has ended.
  void rethrow() {
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

  /// Valid while this object lives.
  Progress function() {
    return [this](std::string_view stage, double share) { return (*this)(stage, share); };
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  double most_ = 0;
  bool stopped_ = false;
  std::exception_ptr thrown_;
};

}  // namespace geotherm
