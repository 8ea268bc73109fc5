// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>

namespace geotherm::app {

/// Says how long the loop may sleep, and how many frames a second were drawn of late.
class FrameClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Frames that follow something that happened: what is laid out anew settles in two. Where the
  /// panels want more, they say so.
  static constexpr int kFramesAfterEvent = 2;

  void something_happened() { frames_left_ = kFramesAfterEvent; }
  bool frame_is_due() const { return frames_left_ > 0; }

  void begin_frame() {
    const Clock::time_point now = Clock::now();
    if (frames_left_ > 0) --frames_left_;
    // A pause is no slow frame.
    if (!begins_.empty() && now - begins_.back() > std::chrono::seconds(1)) begins_.clear();
    begins_.push_back(now);
    if (begins_.size() > kFrames) begins_.pop_front();
  }

  double frames_per_second() const {
    if (begins_.size() < 2) return 0;
    const std::chrono::duration<double> span = begins_.back() - begins_.front();
    return span.count() > 0 ? static_cast<double>(begins_.size() - 1) / span.count() : 0;
  }

 private:
  static constexpr std::size_t kFrames = 30;
  int frames_left_ = kFramesAfterEvent;
  std::deque<Clock::time_point> begins_;
};

}  // namespace geotherm::app
