// SPDX-License-Identifier: MIT
#include <algorithm>
#include <sstream>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

/// A camera as the log names it.
struct Place {
  double azimuth = 0, elevation = 0, zoom = 1, right = 0, up = 0;
};

class Mouse : public PlayedWindow {
 protected:
  /// A command that says where the camera is now: of two movements the log keeps the end.
  Place camera() {
    run({"camera orbit 0 0", "camera orbit 0 0"});
    const std::string line = log().back();
    std::istringstream words(line);
    std::string camera, place;
    Place found;
    words >> camera >> place >> found.azimuth >> found.elevation >> found.zoom >> found.right >>
        found.up;
    EXPECT_TRUE(words && place == "place") << line;
    return found;
  }
};

TEST_F(Mouse, MovesTheCameraAsTheTableOfKeysSays) {
  start({"bunny"});
  const Place first = camera();

  drag(kBody, {kBody.x + 60, kBody.y + 30});
  const Place turned = camera();
  EXPECT_LT(turned.azimuth, first.azimuth);
  EXPECT_GT(turned.elevation, first.elevation);
  EXPECT_EQ(turned.zoom, first.zoom);
  EXPECT_EQ(turned.right, first.right);

  drag(kBody, {kBody.x, kBody.y - 40}, "ctrl");
  const Place zoomed = camera();
  EXPECT_EQ(zoomed.azimuth, turned.azimuth);
  EXPECT_EQ(zoomed.elevation, turned.elevation);
  EXPECT_GT(zoomed.zoom, turned.zoom);

  drag(kBody, {kBody.x + 30, kBody.y}, "shift");
  const Place shifted = camera();
  EXPECT_EQ(shifted.azimuth, zoomed.azimuth);
  EXPECT_EQ(shifted.zoom, zoomed.zoom);
  EXPECT_GT(shifted.right, zoomed.right);

  drag(kBody, {kBody.x - 30, kBody.y + 20}, "", 2);
  const Place moved = camera();
  EXPECT_EQ(moved.azimuth, zoomed.azimuth);
  EXPECT_LT(moved.right, shifted.right);
  EXPECT_LT(moved.up, shifted.up);

  turn_wheel(kHead, true);
  const Place closer = camera();
  EXPECT_GT(closer.zoom, moved.zoom);
  EXPECT_EQ(closer.azimuth, moved.azimuth);
  turn_wheel(kHead, false);
  const Place farther = camera();
  EXPECT_NEAR(farther.zoom, moved.zoom, 1e-9 * moved.zoom);
  EXPECT_NEAR(farther.right, moved.right, 1e-9);
  quit();
}

TEST_F(Mouse, SetsAddsAndRemovesSources) {
  start({"bunny"});
  const std::size_t before = log().size();
  click(kBody);
  click(kHead, "shift");
  click(kHead, "alt");
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

}  // namespace
}  // namespace geotherm::test
