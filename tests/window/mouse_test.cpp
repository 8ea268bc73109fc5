// SPDX-License-Identifier: MIT
#include <sstream>
#include <tuple>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

constexpr double kMouseRounding = 1e-9;

/// A camera as the log names it.
struct Place {
  double azimuth = 0, elevation = 0, zoom = 1, right = 0, up = 0;
};

using Mouse = PlayedWindow;

/// Of lines of the log, those that say where the camera is.
std::vector<Place> places_in(const std::vector<std::string>& lines) {
  std::vector<Place> places;
  for (const std::string& line : lines) {
    std::istringstream words(line);
    std::string camera, what;
    Place p;
    words >> camera >> what >> p.azimuth >> p.elevation >> p.zoom >> p.right >> p.up;
    if (words && what == "place") places.push_back(p);
  }
  return places;
}

TEST_F(Mouse, MovesTheCameraAsTheTableOfKeysSays) {
  start({"bunny", "--azimuth", "100", "--elevation", "10"});
  // Of movements in a row the log keeps the end: another command stands between each two.
  drag(kBody, {kBody.x + 60, kBody.y + 30});
  press("2");
  drag(kBody, {kBody.x, kBody.y - 40}, "ctrl");
  press("3");
  drag(kBody, {kBody.x + 30, kBody.y}, "shift");
  press("2");
  drag(kBody, {kBody.x - 30, kBody.y + 20}, "", 2);
  press("3");
  turn_wheel(kHead, true, 2);
  press("2");
  turn_wheel(kHead, false, 2);
  const std::vector<Place> places = places_in(log());
  ASSERT_EQ(places.size(), 6U);
  const auto& [turned, zoomed, shifted, moved, closer, farther] =
      std::tie(places[0], places[1], places[2], places[3], places[4], places[5]);

  EXPECT_LT(turned.azimuth, 100);
  EXPECT_GT(turned.elevation, 10);
  EXPECT_EQ(turned.zoom, 1);
  EXPECT_EQ(turned.right, 0);

  EXPECT_EQ(zoomed.azimuth, turned.azimuth);
  EXPECT_EQ(zoomed.elevation, turned.elevation);
  EXPECT_GT(zoomed.zoom, turned.zoom);

  EXPECT_EQ(shifted.azimuth, zoomed.azimuth);
  EXPECT_EQ(shifted.zoom, zoomed.zoom);
  EXPECT_GT(shifted.right, zoomed.right);

  EXPECT_EQ(moved.azimuth, zoomed.azimuth);
  EXPECT_LT(moved.right, shifted.right);
  EXPECT_LT(moved.up, shifted.up);

  EXPECT_GT(closer.zoom, moved.zoom);
  EXPECT_EQ(closer.azimuth, moved.azimuth);
  EXPECT_NEAR(farther.zoom, moved.zoom, kMouseRounding * moved.zoom);
  EXPECT_NEAR(farther.right, moved.right, kMouseRounding);
  EXPECT_NEAR(farther.up, moved.up, kMouseRounding);
  quit();
}

TEST_F(Mouse, SetsAddsAndRemovesSources) {
  start({"bunny"});
  const std::size_t before = log().size();
  click(kBody);
  click(kHead, "shift");
  press("Delete");
  click(kEar, "ctrl");
  const std::vector<std::string> commands = log();
  ASSERT_EQ(commands.size(), before + 4);
  EXPECT_TRUE(commands[before].starts_with("source set face:")) << commands[before];
  EXPECT_TRUE(commands[before + 1].starts_with("source add face:")) << commands[before + 1];
  EXPECT_EQ(commands[before + 2], "source remove 1");
  EXPECT_TRUE(commands[before + 3].starts_with("pick face:")) << commands[before + 3];
  quit();
}

TEST_F(Mouse, DragsASource) {
  start({"bunny"});
  click(kBody);
  const std::size_t before = log().size();
  drag(kBody, {kBody.x + 40, kBody.y + 30});
  const std::vector<std::string> commands = log();
  ASSERT_EQ(commands.size(), before + 1);
  EXPECT_TRUE(commands[before].starts_with("source move 0 face:")) << commands[before];
  quit();
}

TEST_F(Mouse, SetsAndDragsASourceInsideAVolumeThatIsCutOpen) {
  ASSERT_EQ(
      run_program(path("."), {"generate", "ball-tets", "--tets", "2000", "-o", "ball.mesh"}).code,
      0);
  start({"ball.mesh", "--azimuth", "0", "--elevation", "0", "--slice", "z"}, 4);
  click(kBody);
  drag(kBody, {kBody.x + 60, kBody.y - 50});
  // What the window has drawn step by step is what one finds who asks for the last at once.
  const auto expect_same = [this](const std::string& log_name) {
    const Picture saved = picture_in(path(log_name + ".png"));
    const std::string size = std::to_string(saved.width) + "x" + std::to_string(saved.height);
    const ProgramRun replay = run_program(path("."), {"view", "--replay", log_name + ".geotherm",
                                                      "--size", size, "-o", "replayed.png"});
    ASSERT_EQ(replay.code, 0) << replay.err;
    EXPECT_LE(share_that_differs(saved, picture_in(path("replayed.png"))), kSamePicture);
  };
  run({"save picture log1.png"});
  const std::vector<std::string> lines = log();
  expect_same("log1");
  run({"peel below:0.5", "save picture log2.png"});
  log();
  expect_same("log2");
  EXPECT_EQ(line_with(lines, "source set xyz:").substr(0, 15), "source set xyz:");
  const std::string moved = line_with(lines, "source move 0 xyz:");
  EXPECT_EQ(moved.substr(moved.rfind(':')), ":0") << "on the plane z = 0";
  quit();
}

}  // namespace
}  // namespace geotherm::test
