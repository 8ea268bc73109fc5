// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

class Trouble : public PlayedWindow {
 protected:
  /// The window still works: it takes a command, shows the model and writes its picture.
  void expect_life(const std::string& picture) {
    run({"save picture " + picture});
    ASSERT_TRUE(eventually([&] { return is_there(picture); }));
    EXPECT_GT(picture_in(path(picture)).width, 0);
  }
};

TEST_F(Trouble, FileThatCannotBeOpenedLeavesTheModel) {
  start({"bunny"});
  run({"save picture before.png", "open missing.obj", "save picture after.png",
       "save session s.geotherm"});
  const std::vector<std::string> session = lines_of(path("s.geotherm"));
  EXPECT_EQ(std::count(session.begin(), session.end(), "open bunny"), 1);
  EXPECT_EQ(std::count(session.begin(), session.end(), "open missing.obj"), 0);
  EXPECT_EQ(share_that_differs(picture_in(path("before.png")), picture_in(path("after.png"))), 0);
  quit();
}

TEST_F(Trouble, FileThatIsDeletedIsNotNeededAnyMore) {
  for (const Sample& sample : pyramid_samples()) {
    if (sample.file.ends_with(".obj")) folder_.write("pyramid.obj", sample.bytes);
  }
  start({"pyramid.obj"});
  std::filesystem::remove(path("pyramid.obj"));
  run({"backend eigen-ldlt", "constraint penalty:10", "save distances d.csv"});
  EXPECT_TRUE(is_there("d.csv"));
  quit();
}

TEST_F(Trouble, WindowMayBeTinyAndHuge) {
  start({"bunny"});
  const Picture before = canvas_on_screen();
  resize(1, 1);
  resize(300, 90);
  resize(2600, 1700);
  resize(1280, 800);
  EXPECT_LE(share_that_differs(canvas_on_screen(), before), kSamePicture);
  expect_life("p.png");
  quit();
}

TEST_F(Trouble, WindowMayDisappearAndComeBack) {
  start({"bunny"});
  const Picture before = canvas_on_screen();
  xdotool("windowunmap --sync " + window());
  EXPECT_TRUE(program_->runs());
  const long used = program_->ticks();
  xdotool("windowmap --sync " + window());
  EXPECT_TRUE(program_->notice(used, 1));
  EXPECT_LE(share_that_differs(canvas_on_screen(), before), kSamePicture);
  expect_life("p.png");
  quit();
}

TEST_F(Trouble, WithoutADisplayIsOneLineThatNamesTheWayOut) {
  ::unsetenv("DISPLAY");
  const ProgramRun run = run_program(path("."), {"bunny"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.starts_with("geotherm: error: ")) << run.err;
  EXPECT_EQ(run.err.find('\n'), run.err.size() - 1) << run.err;
  EXPECT_NE(run.err.find("geotherm render"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("--replay"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace geotherm::test
