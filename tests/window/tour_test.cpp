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

/// The vertices behind "curve:" in the last source of a line.
std::vector<std::size_t> curve_in(const std::string& line) {
  std::vector<std::size_t> vertices;
  const std::string word = "curve:";
  const std::size_t begin = line.rfind(word);
  if (begin == std::string::npos) return vertices;
  std::istringstream list(line.substr(begin + word.size()));
  for (std::string vertex; std::getline(list, vertex, ',');) vertices.push_back(std::stoul(vertex));
  return vertices;
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
    EXPECT_GT(curve_in(sources).size(), 1U) << sources;
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
    for (const std::size_t vertex : curve_in(line_with(session, "source set"))) {
      ASSERT_LT(vertex, distances.size());
      EXPECT_LE(distances[vertex], kAtSources * largest) << vertex;
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

  /// With the energy conserved, sources are at 0 on average.
  static constexpr double kAtSources = 0.1;
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
  EXPECT_NE(line_with(commands_, "source add curve:"), "");
  EXPECT_NE(line_with(commands_, "source extend "), "");
}

}  // namespace
}  // namespace geotherm::test
