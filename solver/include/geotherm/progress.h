// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <string_view>

#include "geotherm/error.h"

// How long work reports and is cancelled.
namespace geotherm {

/// Called now and then during long work with the stage's name and the share done (0 to 1, or
/// negative when unknown). Returning false asks the work to stop with ErrorCode::kCancelled.
/// It may be called from any thread of the work, but by one at a time; the work waits for it.
/// An empty function means: nobody watches. What it throws stops the work, on all threads, and is
/// thrown by the function that was given it (std::bad_alloc counts as the memory that ended); the
/// work leaves nothing behind, and a method can be asked again.
using Progress = std::function<bool(std::string_view stage, double share)>;

/// Tells it, where there is one; false: stop.
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

}  // namespace geotherm
