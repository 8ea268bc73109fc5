// SPDX-License-Identifier: MIT
#include "tests/ui/driver.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

class LogPanel : public UiTest {
 protected:
  void SetUp() override {
    Layout layout = everything_open();
    layout.log = true;
    layout.log_height = 300;
    restart(layout);
    open_square();
  }
};

TEST_F(LogPanel, TakesCommands) {
  fill("Log/command", "time-factor 3");
  EXPECT_EQ(sent(), Texts{"time-factor 3"});
  // The field is ready for the next one.
  frames(2);
  type("view flat");
  key(kKeyEnter);
  EXPECT_EQ(sent(), Texts{"view flat"});
}

TEST_F(LogPanel, KeepsWhatIsNoCommandToBeMended) {
  fill("Log/command", "no such command");
  EXPECT_EQ(sent(), Texts{});
  click_item("Log/command");
  hold(true, false, false);
  key('A');
  hold(false, false, false);
  type("undo");
  key(kKeyEnter);
  EXPECT_EQ(sent(), Texts{"undo"});
}

TEST_F(LogPanel, BringsBackWhatWasTypedBefore) {
  fill("Log/command", "view flat");
  frames(2);
  fill("Log/command", "view smooth");
  frames(2);
  sent();
  key(kKeyUp);
  key(kKeyUp);
  key(kKeyEnter);
  EXPECT_EQ(sent(), Texts{"view flat"});
}

TEST_F(LogPanel, BreaksItsLinesWhereItIsNarrow) {
  ImGui::GetIO().DisplaySize = {350, 700};
  Layout layout;
  layout.left = layout.right = false;
  layout.log = true;
  layout.log_height = 300;
  restart(layout);
  fill("Log/command", "boundary dirichlet-and-something-that-no-setting-has");
  frames(2);
  for (const char* item : {"Log/errors", "Log/follow", "Log/copy", "Log/error", "Log/command"}) {
    const auto place = panels_->place_of_item(item);
    ASSERT_TRUE(place) << item;
    EXPECT_LE(place->x + place->width, 350) << item;
    EXPECT_LT(place->y + place->height, 700) << item;
  }
  EXPECT_GT(panels_->place_of_item("Log/error")->height, 1.5F * ImGui::GetFontSize());
}

TEST_F(LogPanel, CopiesTheLinesThatAreShown) {
  std::string copied;
  ImGuiIO& io = ImGui::GetIO();
  io.ClipboardUserData = &copied;
  io.SetClipboardTextFn = [](void* user, const char* text) {
    *static_cast<std::string*>(user) = text;
  };
  run("view flat");
  frame();
  click_item("Log/copy");
  EXPECT_NE(copied.find("view flat"), std::string::npos);
  click_item("Log/commands");
  click_item("Log/copy");
  EXPECT_EQ(copied.find("view flat"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::ui
