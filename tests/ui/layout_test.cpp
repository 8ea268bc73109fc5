// SPDX-License-Identifier: MIT
#include "ui/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace geotherm::ui {
namespace {

namespace fs = std::filesystem;

Layout another_layout() {
  Layout layout;
  layout.left_width = 287.25F;
  layout.right_width = 401.1F;
  layout.log_height = 99;
  layout.left = false;
  layout.log = true;
  layout.theme = Theme::kLight;
  layout.scale = 1.25F;
  layout.open = {{"Solver", false}, {"Compare backends", true}};
  layout.recent = {"/a/b = c.obj", "/d e/f.ply"};
  return layout;
}

class LayoutFile : public ::testing::Test {
 protected:
  LayoutFile()
      : folder_(fs::path(::testing::TempDir()) /
                (std::string("geotherm_layout_") +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~LayoutFile() override { fs::remove_all(folder_); }

  const fs::path folder_;
};

TEST(LayoutText, ReadsBackExactly) {
  EXPECT_EQ(parse_layout(to_text(another_layout())), another_layout());
  EXPECT_EQ(parse_layout(to_text(Layout{})), Layout{});
}

TEST(LayoutText, LeavesWhatIsUnknownOrOutOfRangeAtItsDefault) {
  const Layout layout = parse_layout(
      "left-width = -3\nright-width = nan\nlog-height = 1e30\nscale = 0\nleft = maybe\n"
      "theme = blue\nopen = on\nopen  = on\nopen Solver = yes\nno sign\n= 5\nfuture = 3\n");
  EXPECT_EQ(layout, Layout{});
}

TEST(LayoutText, ReadsWhatIsRightBesideWhatIsNot) {
  const Layout layout = parse_layout("garbage\r\n left = off \r\nscale = 2\r\nleft-width = x");
  EXPECT_FALSE(layout.left);
  EXPECT_EQ(layout.scale, 2);
  EXPECT_EQ(layout.left_width, Layout{}.left_width);
}

TEST(LayoutText, RemembersTheModelsThatWereOpenedLast) {
  Layout layout;
  for (int i = 0; i < 12; ++i) add_recent(layout, "/m" + std::to_string(i) + ".obj");
  add_recent(layout, "/m7.obj");
  ASSERT_EQ(layout.recent.size(), kMaxRecent);
  EXPECT_EQ(layout.recent[0], "/m7.obj");
  EXPECT_EQ(layout.recent[1], "/m11.obj");
  EXPECT_EQ(std::count(layout.recent.begin(), layout.recent.end(), "/m7.obj"), 1);
  add_recent(layout, "/two\nlines.obj");
  EXPECT_EQ(layout.recent[0], "/m7.obj");
}

TEST(LayoutText, SurvivesDamage) {
  const std::string text = to_text(another_layout());
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = text.substr(0, random() % (text.size() + 1));
    for (int k = 0; k < 3 && !damaged.empty(); ++k) {
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    }
    const Layout layout = parse_layout(damaged);
    EXPECT_GE(layout.left_width, 160);
    EXPECT_LE(layout.left_width, 1200);
    EXPECT_GE(layout.scale, 0.5F);
    EXPECT_LE(layout.scale, 4);
  }
}

TEST_F(LayoutFile, IsRememberedInAFolderThatIsMade) {
  const std::string path = (folder_ / "new" / "geotherm" / "viewer.conf").string();
  ASSERT_TRUE(save_layout(path, another_layout()));
  EXPECT_EQ(load_layout(path), another_layout());
  ASSERT_TRUE(save_layout(path, Layout{}));  // over the first
  EXPECT_EQ(load_layout(path), Layout{});
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(path).parent_path()), {}), 1);
}

TEST_F(LayoutFile, IsTheDefaultWhereThereIsNone) {
  EXPECT_EQ(load_layout((folder_ / "none").string()), Layout{});
  EXPECT_EQ(load_layout(folder_.string()), Layout{});
  EXPECT_EQ(load_layout(""), Layout{});
}

TEST_F(LayoutFile, ThatCannotBeWrittenIsSaidSo) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_FALSE(save_layout((folder_ / "file" / "viewer.conf").string(), Layout{}));
  EXPECT_FALSE(save_layout("", Layout{}));
  fs::create_directories(folder_ / "taken");
  EXPECT_FALSE(save_layout((folder_ / "taken").string(), Layout{}));
  EXPECT_FALSE(fs::exists(folder_ / "taken.part"));
}

TEST(LayoutPath, LiesInTheUsersConfigurationFolder) {
  const char* before = std::getenv("XDG_CONFIG_HOME");
  const std::string kept = before ? before : "";
  setenv("XDG_CONFIG_HOME", "/somewhere", 1);
  EXPECT_EQ(layout_path(), "/somewhere/geotherm/viewer.conf");
  setenv("XDG_CONFIG_HOME", "not/absolute", 1);
  EXPECT_EQ(layout_path().find("not/absolute"), std::string::npos);
  if (before) {
    setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
  } else {
    unsetenv("XDG_CONFIG_HOME");
  }
}

}  // namespace
}  // namespace geotherm::ui
