// SPDX-License-Identifier: MIT
#include <csignal>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

/// What the window remembers however it ends, and what it is called.
class Remembered : public PlayedWindow, public testing::WithParamInterface<int> {
 protected:
  bool remembers(const std::string& line) {
    return bytes_of(path("config/geotherm/viewer.conf")).find(line + "\n") != std::string::npos;
  }
};

TEST_P(Remembered, IsHowThePanelsLieAndWhatWasOpenedAfterASignal) {
  start({});
  ASSERT_EQ(run_program(path("."), {"generate", "bunny", "-o", "mine.ply"}).code, 0);
  run({"open mine.ply"});
  EXPECT_FALSE(remembers("right = off"));
  press("F3");
  ASSERT_EQ(::kill(program_->process(), GetParam()), 0);
  EXPECT_EQ(program_->end().code, 128 + GetParam());
  EXPECT_TRUE(remembers("right = off"));
  EXPECT_TRUE(remembers("recent = " + path("mine.ply")));
}

INSTANTIATE_TEST_SUITE_P(Signals, Remembered, testing::Values(SIGTERM, SIGINT),
                         [](const auto& test) {
                           return std::string(test.param == SIGTERM ? "Terminate" : "Interrupt");
                         });

/// A picture larger than others has no other letters: they are those of the panels.
using Seen = PlayedWindow;

TEST_F(Seen, SessionIsDrawnElsewhereAsLargeAsItWasSeen) {
  start({"bunny"}, 4);
  resize(1001, 700);
  run({"save session s.geotherm", "save picture p.png"});
  ASSERT_TRUE(eventually([this] { return is_there("p.png"); }));
  quit();
  const ProgramRun replay =
      run_program(path("."), {"view", "--replay", "s.geotherm", "-o", "replayed.png"});
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_LE(share_that_differs(picture_in(path("p.png")), picture_in(path("replayed.png"))),
            kSamePicture);
  const ProgramRun other = run_program(
      path("."), {"view", "--replay", "s.geotherm", "--size", "300x200", "-o", "small.png"});
  ASSERT_EQ(other.code, 0) << other.err;
  EXPECT_EQ(picture_in(path("small.png")).width, 300);
}

/// The model stays where it is whatever stands beside it.
TEST_F(Seen, PlaceOfTheModelIsThatBeforeThereWasABar) {
  start({"bunny", "--view", "smooth", "--no-markers"});
  const Picture smooth = canvas_on_screen();
  run({"view sources"});
  const Picture with_colours = canvas_on_screen();
  run({"view contours"});
  const Picture contours = canvas_on_screen();
  // The outline: where the middle row changes from background to model.
  const auto outline = [](const Picture& picture) {
    std::vector<int> places;
    for (const int row : {picture.height / 3, picture.height / 2}) {
      int x = 0;
      const auto white = [&](int at) {
        return picture.pixels[3 * (static_cast<std::size_t>(row) * picture.width + at)] == 255 &&
               picture.pixels[3 * (static_cast<std::size_t>(row) * picture.width + at) + 2] == 255;
      };
      while (x < picture.width && white(x)) ++x;
      places.push_back(x);
    }
    return places;
  };
  EXPECT_EQ(outline(smooth), outline(contours));
  EXPECT_EQ(outline(smooth), outline(with_colours));
  quit();
}

}  // namespace
}  // namespace geotherm::test
