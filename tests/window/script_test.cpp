// SPDX-License-Identifier: MIT
#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

class Script : public PlayedWindow {
 protected:
  ProgramRun play(const std::string& script) {
    folder_.write("s.geotherm", script);
    PlayedProgram program(path("."), {"view", "--script", "s.geotherm", "--validation"});
    return program.end();
  }
};

TEST_F(Script, RunsInTheWindowAndWaitsForAnswers) {
  const ProgramRun run = play(
      "open bunny\n"
      "source set 17\n"
      "save distances near.csv\n"
      "source set 1700\n"
      "save distances far.csv\n"
      "view heat-gradient\n"
      "save picture p.png 320x240\n"
      "save picture panels.png panels\n"
      "quit\n");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const std::string near = bytes_of(path("near.csv")), far = bytes_of(path("far.csv"));
  EXPECT_FALSE(near.empty());
  EXPECT_FALSE(far.empty());
  EXPECT_NE(near, far);
  EXPECT_EQ(picture_in(path("p.png")).width, 320);
  EXPECT_EQ(picture_in(path("panels.png")).width, width_);
}

TEST_F(Script, WithABadLineIsRefusedWithItsPlace) {
  const ProgramRun run = play("open bunny\nsave distances d.csv\ntime-factor x\n");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("s.geotherm: line 3, column 13: "), std::string::npos) << run.err;
  EXPECT_FALSE(is_there("d.csv"));
}

}  // namespace
}  // namespace geotherm::test
