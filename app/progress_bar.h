// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "app/announce.h"
#include "geotherm/progress.h"

namespace geotherm::app {

/// A bar on standard error, drawn over itself at most ten times a second and removed when it goes.
/// Draws nothing in the first tenth of a second, so that short work shows none.
class ProgressBar {
 public:
  explicit ProgressBar(bool shown) : shown_(shown) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { clear(); }

  /// For the library; the bar must outlive it.
  Progress progress();

  /// Writes a line of its own to standard error, whether or not the bar is shown. Not at the same
  /// time as a call of the progress.
  Announce announce();

  void clear();

  /// One line without its end: "solve  [=====>    ]  47 %"; an unknown share (below 0) has no bar.
  static std::string line(std::string_view stage, double share);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::string_view stage, double share);

  bool shown_;
  bool drawn_ = false;
  Clock::time_point last_ = Clock::now();
};

/// True when standard error is a terminal.
bool error_is_terminal();

/// The same progress with `prefix` before each stage.
Progress with_prefix(Progress progress, std::string prefix);

}  // namespace geotherm::app
