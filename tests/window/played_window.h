// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/support/private_display.h"
#include "tests/window/pictures.h"
#include "tests/window/played_program.h"

namespace geotherm::test {

/// Pixels of the window from its top left corner, which is that of the screen: there is no window
/// manager.
struct Spot {
  int x = 0, y = 0;
};

/// The program in a window on a display of its own, without a user's settings, played with mouse
/// and keys. Skipped where the window cannot be opened, or failed where GEOTHERM_REQUIRE_VULKAN
/// is 1.
class PlayedWindow : public testing::Test {
 protected:
  void SetUp() override;

  /// Starts the program, with validation, and waits until it has drawn its first picture. One
  /// sample a pixel is drawn fastest.
  void start(std::vector<std::string> arguments, int samples = 1);
  /// Ctrl+Q: it ends without a word.
  void quit();

  void move_to(Spot spot);
  void click(Spot spot, const std::string& modifier = "", int button = 1);
  /// Step by step, as a hand does.
  void drag(Spot from, Spot to, const std::string& modifier = "", int button = 1);
  void turn_wheel(Spot spot, bool up, int notches);
  /// A key by its name of X, such as Tab, or with a modifier: ctrl+s.
  void press(const std::string& key);
  /// Types, and Enter at the end.
  void enter(const std::string& text);
  void resize(int width, int height);

  /// Types commands into the field under the log.
  void run(const std::vector<std::string>& commands);
  /// The commands so far, of a log that is saved for that. Without those that saved logs.
  std::vector<std::string> log();
  /// The commands of a file of commands.
  std::vector<std::string> lines_of(const std::string& path) const;

  /// What is between the panels.
  Picture canvas_on_screen();
  std::string path(const std::string& name) const { return folder_.path(name); }
  bool is_there(const std::string& name) const;
  const std::string& window() const { return window_; }  ///< its number

  TemporaryDirectory folder_;  ///< where the program runs
  std::optional<PrivateDisplay> display_;
  std::optional<PlayedProgram> program_;
  int width_ = 1280, height_ = 800;

 private:
  void give_up(const std::string& why);
  /// Until it has drawn all that follows from what was done.
  void settle();
  /// What xdotool does, and a frame that has seen it.
  void play(const std::string& words, long ticks = kNotice);
  /// The same where it holds something down; then frames follow each other. What goes down and up
  /// within one frame would be lost.
  void hold(const std::string& words);
  void point_at(Spot spot);
  void leave_field();

  /// Clock ticks: more than waking up takes, so that what came is taken in and drawn.
  static constexpr long kNotice = 4;

  std::string window_;  ///< its number
  int logs_ = 0;
  bool in_field_ = false;  ///< letters go to the field under the log
};

/// The line that begins like this; empty where there is none.
std::string line_with(const std::vector<std::string>& lines, const std::string& beginning);

// Where things are in a window of 1280 x 800 with the log shown.
inline constexpr Spot kEar{640, 150}, kHead{530, 340}, kBody{600, 420};
inline constexpr Spot kConstraintChoice{195, 496}, kTimeFactorField{248, 384};
inline constexpr Spot kPanel{150, 228};  ///< nothing that could be hit

}  // namespace geotherm::test
