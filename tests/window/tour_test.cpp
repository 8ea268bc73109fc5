// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

constexpr double kNothing = 1e-9;  ///< of the largest distance

bool contains(const std::vector<std::string>& lines, const std::string& line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

/// Of a .csv: one line of names, then vertex and distance.
std::vector<double> distances_in(const std::string& path) {
  std::istringstream text(bytes_of(path));
  std::vector<double> distances;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) distances.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  return distances;
}

class Tour : public PlayedWindow {
 protected:
  /// Opens, sets a source and changes the method in all the ways there are.
  void explore() {
    run({"open bunny", "backend eigen-ldlt"});
    click(kBody);
    click(kTimeFactorField);
    enter("2.5");
    click(kConstraintChoice);
    click({kConstraintChoice.x, kConstraintChoice.y + 86});  // the fourth of the list
  }
  void paint() {
    press("b");
    drag(kHead, {kHead.x + 20, kHead.y - 60});
    press("b");
  }
  void save() {
    press("ctrl+s");
    enter("tour.geotherm");
    run({"save distances d.csv", "save picture p.png"});
    commands_ = log();  // log1
  }

  void expect_session() {
    const auto session = lines_of(path("tour.geotherm"));
    EXPECT_TRUE(contains(session, "open bunny"));
    EXPECT_TRUE(contains(session, "backend eigen-ldlt"));
    EXPECT_TRUE(contains(session, "time-factor 2.5"));
    EXPECT_TRUE(contains(session, "constraint conserve-energy"));
    const std::string sources = line_with(session, "source set face:");
    EXPECT_NE(sources.find(" curve:face:"), std::string::npos) << sources;
  }
  void expect_distances() {
    const std::vector<double> distances = distances_in(path("d.csv"));
    ASSERT_FALSE(distances.empty());
    double largest = 0;
    for (const double distance : distances) {
      ASSERT_TRUE(std::isfinite(distance));
      largest = std::max(largest, distance);
    }
    ASSERT_GT(largest, 0);
    const auto session = lines_of(path("tour.geotherm"));
    // Those of the command line from the same sources.
    std::vector<std::string> words = {"solve", "bunny",     "--backend",    "eigen-ldlt",
                                      "-m",    "2.5",       "--constraint", "conserve-energy",
                                      "-o",    "solved.csv"};
    std::istringstream sources(line_with(session, "source set").substr(10));
    for (std::string source; sources >> source;) {
      words.emplace_back("-s");
      words.push_back(source);
    }
    const ProgramRun solved = run_program(path("."), words);
    ASSERT_EQ(solved.code, 0) << solved.err;
    const std::vector<double> expected = distances_in(path("solved.csv"));
    ASSERT_EQ(expected.size(), distances.size());
    for (std::size_t v = 0; v < expected.size(); ++v) {
      ASSERT_NEAR(distances[v], expected[v], kNothing * largest) << v;
    }
    EXPECT_GE(*std::min_element(distances.begin(), distances.end()), -kNothing * largest);
  }
  void expect_pictures(const Picture& screen) {
    const Picture saved = picture_in(path("p.png"));
    ASSERT_GT(saved.width, 0);
    EXPECT_LE(share_that_differs(saved, screen), kSamePicture);
    const std::string size = std::to_string(saved.width) + "x" + std::to_string(saved.height);
    const ProgramRun replay = run_program(
        path("."), {"view", "--replay", "log1.geotherm", "--size", size, "-o", "replayed.png"});
    ASSERT_EQ(replay.code, 0) << replay.err;
    EXPECT_LE(share_that_differs(saved, picture_in(path("replayed.png"))), kSamePicture);
  }

  std::vector<std::string> commands_;
};

TEST_F(Tour, LeadsToTheSamePictureOnScreenInAFileAndReplayed) {
  start({}, 4);
  explore();
  paint();
  for (const auto& [width, height] : {std::pair(900, 700), {1001, 563}, {1280, 800}, {1160, 770}}) {
    resize(width, height);
  }
  save();
  const Picture screen = canvas_on_screen();
  quit();
  expect_session();
  expect_distances();
  expect_pictures(screen);
  // The pointer was clicked, the brush dragged: in the log as what they did.
  EXPECT_NE(line_with(commands_, "source set face:"), "");
  EXPECT_NE(line_with(commands_, "source add curve:face:"), "");
  EXPECT_NE(line_with(commands_, "source extend face:"), "");
}

}  // namespace
}  // namespace geotherm::test
