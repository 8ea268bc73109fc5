// SPDX-License-Identifier: MIT
#include <thread>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

using Idle = PlayedWindow;

constexpr std::chrono::seconds kWhile{2};

/// Where nothing happens nothing is drawn: a pause of seconds costs less than one of the frames
/// that follow when the mouse moves, of which there are three at least.
TEST_F(Idle, WindowUsesLessThanAFrameOfProcessorTime) {
  start({"bunny"});
  move_to(kPanel);
  const long begin = program_->ticks();
  move_to({kPanel.x + 4, kPanel.y});
  const long three_frames = program_->ticks() - begin;
  const long before = program_->ticks();
  std::this_thread::sleep_for(kWhile);
  EXPECT_LE(3 * (program_->ticks() - before), three_frames);
  quit();
}

}  // namespace
}  // namespace geotherm::test
