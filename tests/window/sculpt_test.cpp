// SPDX-License-Identifier: MIT
// Sculpting with a real mouse, and frames that are played.
#include <algorithm>
#include <fstream>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

class Sculpt : public PlayedWindow {
 protected:
  /// Runs a log without a window and saves what it leads to.
  std::string replayed_mesh(const std::string& log) {
    std::ofstream script(path("again.geotherm"));
    for (const std::string& line : lines_of(path(log))) {
      if (!line.starts_with("save ")) script << line << '\n';
    }
    script << "save mesh again.ply\n" << std::flush;
    const ProgramRun run =
        run_program(path("."), {"view", "--headless", "--script", "again.geotherm"});
    EXPECT_EQ(run.code, 0) << run.err;
    return bytes_of(path("again.ply"));
  }
};

TEST_F(Sculpt, AStrokeBendsTheSurfaceAndReplaysToTheSameBits) {
  start({"bunny", "-s", "17"});
  run({"save mesh before.ply"});
  const Picture before = canvas_on_screen();
  press("s");
  drag(kBody, {kBody.x + 60, kBody.y + 40});
  drag(kHead, {kHead.x + 30, kHead.y - 30}, "shift");
  press("s");
  move_to(kPanel);
  EXPECT_GT(share_that_differs(canvas_on_screen(), before), kSamePicture);
  run({"save mesh bent.ply"});
  const std::vector<std::string> commands = log();  // log1
  EXPECT_NE(line_with(commands, "sculpt pull "), "");
  EXPECT_NE(line_with(commands, "sculpt smooth "), "");
  EXPECT_EQ(
      std::ranges::count_if(commands, [](const auto& line) { return line.starts_with("sculpt "); }),
      2);
  const std::string bent = bytes_of(path("bent.ply"));
  EXPECT_TRUE(bent != bytes_of(path("before.ply")));
  EXPECT_TRUE(replayed_mesh("log1.geotherm") == bent);
  press("ctrl+z");
  press("ctrl+z");
  run({"save mesh undone.ply"});
  EXPECT_TRUE(bytes_of(path("undone.ply")) == bytes_of(path("before.ply")));
  move_to(kPanel);
  EXPECT_LE(share_that_differs(canvas_on_screen(), before), kSamePicture);
  quit();
}

TEST_F(Sculpt, FramesPlayUntilTheLastWithTheirDistances) {
  ASSERT_EQ(run_program(path("."), {"generate", "bunny", "--faces", "1000", "--frames", "5", "-o",
                                    "wave_%d.obj"})
                .code,
            0);
  start({"wave_0.obj", "-s", "17", "--sequence", "wave_%d.obj"});
  const Picture first = canvas_on_screen();
  run({"loop off", "play on"});
  EXPECT_TRUE(eventually([this] { return line_with(log(), "play off") != ""; }));
  EXPECT_NE(line_with(log(), "frame 4"), "");
  EXPECT_GT(share_that_differs(canvas_on_screen(), first), kSamePicture);
  run({"save distances last.csv", "frame 0", "save distances first.csv"});
  EXPECT_TRUE(bytes_of(path("last.csv")) != bytes_of(path("first.csv")));
  quit();
}

}  // namespace
}  // namespace geotherm::test
