// SPDX-License-Identifier: MIT
#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

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
  EXPECT_EQ(commands_of(
                {"1", "2", "3", "4", "5", "6", "7", "plus", "minus", "h", "f", "ctrl+z", "ctrl+y"}),
            (std::vector<std::string>{"view wireframe", "view flat", "view smooth", "view sources",
                                      "view heat-gradient", "view gradient-error", "view contours",
                                      "source more", "source fewer", "source shuffle",
                                      "camera frame", "undo", "redo"}));
  quit();
}

TEST_F(Keys, TurnTheModelUntilTheyArePressedAgain) {
  start({"bunny"});
  const std::size_t before = log().size();
  // It does not rest meanwhile.
  const auto tap = [this] {
    const long used = program_->ticks();
    xdotool("keydown p");
    program_->notice(used);
    xdotool("keyup p");
    program_->notice(program_->ticks(), 10);
  };
  tap();
  tap();
  ASSERT_TRUE(program_->rest());
  const std::vector<std::string> commands = log();
  ASSERT_EQ(commands.size(), before + 3);
  EXPECT_EQ(commands[before], "rotate on");
  EXPECT_TRUE(commands[before + 1].starts_with("camera place ") ||
              commands[before + 1].starts_with("camera orbit "))
      << commands[before + 1];
  EXPECT_EQ(commands[before + 2], "rotate off");
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
