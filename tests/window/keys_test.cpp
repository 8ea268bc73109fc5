// SPDX-License-Identifier: MIT
#include <algorithm>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

constexpr long kFrames = 60;  ///< clock ticks, more than some frames take

class Keys : public PlayedWindow {
 protected:
  /// What pressing these adds to the log.
  std::vector<std::string> commands_of(const std::vector<std::string>& keys) {
    const std::size_t before = log().size();
    for (const std::string& key : keys) press(key);
    std::vector<std::string> commands = log();
    commands.erase(commands.begin(), commands.begin() + static_cast<std::ptrdiff_t>(before));
    return commands;
  }
};

TEST_F(Keys, ChooseTheViewAndTheSources) {
  start({"bunny", "-s", "random:2"});
  EXPECT_EQ(
      commands_of({"1", "2", "3", "4", "5", "6", "7", "plus", "minus", "h", "ctrl+z", "ctrl+y"}),
      (std::vector<std::string>{"view wireframe", "view flat", "view smooth", "view sources",
                                "view heat-gradient", "view gradient-error", "view contours",
                                "source more", "source fewer", "source shuffle", "undo", "redo"}));
  const std::vector<std::string> fitted = commands_of({"f"});
  ASSERT_EQ(fitted.size(), 2u);
  EXPECT_EQ(fitted[0], "camera frame");
  EXPECT_TRUE(fitted[1].starts_with("camera place ")) << fitted[1];
  quit();
}

TEST_F(Keys, TurnTheModelUntilTheyArePressedAgain) {
  start({"bunny"});
  const long used = program_->ticks();
  xdotool("key p");
  EXPECT_TRUE(program_->notice(used, kFrames));  // it does not rest
  xdotool("key p");
  ASSERT_TRUE(program_->rest());
  const std::vector<std::string> commands = log();
  const auto on = std::find(commands.begin(), commands.end(), "rotate on");
  const auto off = std::find(on, commands.end(), "rotate off");
  ASSERT_NE(off, commands.end());
  ASSERT_EQ(off - on, 2);
  EXPECT_TRUE(on[1].starts_with("camera place ")) << on[1];  // several steps
  quit();
}

/// What is typed into a field is no key of the picture.
TEST_F(Keys, AreLettersWhileAFieldIsTypedIn) {
  start({"bunny"});
  const std::vector<std::string> before = log();
  click(kTimeFactorField);
  enter("1");
  EXPECT_EQ(log(), before);
  quit();
}

}  // namespace
}  // namespace geotherm::test
