// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "geotherm/progress.h"

// What long work says before and while it runs: how much it will write, need and take.
namespace geotherm::app {

/// Shows one sentence at once, beside the progress bar. An empty function: announcements are off.
using Announce = std::function<void(const std::string&)>;

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

/// A progress that announces, once, how long work will take whose reports of `stage` hold the true
/// share of what is done: at the second of them or soon after, where more than a second is left.
/// The first part says nothing about the others, since it does what is done once (quality figures).
/// A failure at once leaves its one line alone. `title` stands before the bar instead of the
/// stages, `details` behind the time. The time counts from this call.
Progress with_estimate(Progress progress, const Announce& announce, std::string_view stage,
                       std::string title, std::string details = {});

/// Bytes of a MB, in all that the program prints, reads and writes.
inline constexpr double kMegabyte = 1024.0 * 1024.0;

/// "3.2 GB", "264 MB", "512 bytes": each 2^10 of the one below it, as in --memory-limit.
std::string bytes_in_words(double bytes);

/// "12 s", "3 min 20 s", "2 h 5 min".
std::string seconds_in_words(double seconds);

}  // namespace geotherm::app
