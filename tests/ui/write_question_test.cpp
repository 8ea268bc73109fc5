// SPDX-License-Identifier: MIT
#include <fstream>

#include "tests/ui/driver.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

using Texts = std::vector<std::string>;

class WriteQuestionTest : public UiTest {
 protected:
  void SetUp() override {
    Layout layout = everything_open();
    layout.log = true;
    layout.log_height = 300;
    restart(layout);
    open_square();
  }
  std::string write(const std::string& name, const std::string& text) {
    const std::string path = (folder() / name).string();
    std::ofstream(path) << text;
    return path;
  }
  bool is_asked() {
    frames(2);
    return is_drawn("Write/agree");
  }
};

TEST_F(WriteQuestionTest, ComesBeforeADroppedScriptWritesFiles) {
  const std::string script =
      write("s.geotherm", "save distances " + (folder() / "d.csv").string() + "\n");
  panels_->drop({script});
  frame();
  EXPECT_EQ(sent(), Texts{});
  ASSERT_TRUE(is_asked());
  click_item("Write/cancel");
  EXPECT_FALSE(is_asked());
  EXPECT_EQ(sent(), Texts{});
  panels_->drop({script});
  ASSERT_TRUE(is_asked());
  click_item("Write/agree");
  EXPECT_EQ(sent(), Texts{"run " + script});
  EXPECT_FALSE(is_asked());
}

TEST_F(WriteQuestionTest, DoesNotComeForAScriptThatWritesNothing) {
  const std::string script = write("s.geotherm", "view flat\n");
  panels_->drop({script});
  frame();
  EXPECT_EQ(sent(), Texts{"run " + script});
}

TEST_F(WriteQuestionTest, ComesBeforeATypedCommandReplacesAFile) {
  const std::string path = write("d.csv", "mine\n");
  fill("Log/command", "save distances " + path);
  EXPECT_EQ(sent(), Texts{});
  ASSERT_TRUE(is_asked());
  key(kKeyEscape);
  EXPECT_FALSE(is_asked());
  EXPECT_EQ(sent(), Texts{});
  const std::string fresh = (folder() / "new.csv").string();
  fill("Log/command", "save distances " + fresh);
  EXPECT_EQ(sent(), Texts{"save distances " + fresh});
}

}  // namespace
}  // namespace geotherm::ui
