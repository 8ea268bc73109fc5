// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <exception>
#include <functional>
#include <mutex>
#include <string_view>
#include <utility>

#include "solver/core/result.h"

namespace geotherm {

/// Called now and then during long work with the stage's name and the share done (0 to 1, or
/// negative when unknown). Returning false asks the work to stop with ErrorCode::kCancelled.
/// It may be called from any thread of the work, but by one at a time; the work waits for it.
/// An empty function means: nobody watches. What it throws stops the work, on all threads, and is
/// thrown by the function that was given it (std::bad_alloc counts as the memory that ended); the
/// work leaves nothing behind, and a method can be asked again.
using Progress = std::function<bool(std::string_view stage, double share)>;

inline bool report(const Progress& progress, std::string_view stage, double share) {
  return !progress || progress(stage, share);
}

/// The error of work that its progress has stopped.
inline Error cancelled_error() { return {ErrorCode::kCancelled, "the work was cancelled"}; }

/// The progress of a part of the work: its shares from 0 to 1 become `from` to `to` of the whole.
inline Progress part_of(const Progress& whole, double from, double to) {
  if (!whole) return {};
  return [whole, from, to](std::string_view stage, double share) {
    return whole(stage, share < 0 ? share : from + std::min(share, 1.0) * (to - from));
  };
}

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
