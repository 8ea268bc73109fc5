// SPDX-License-Identifier: MIT
// Sessions on a grid: from where it is seen, what is said of its cells, what is saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "geotherm/domains.h"
#include "tests/explore/session_fixture.h"

namespace geotherm::app {
namespace {

class SessionOnGrid : public SessionFixture {
 protected:
  /// Of these speeds; a picture's worth of doubles is one of speeds.
  std::string grid(const std::string& name, std::array<Index, 3> size, double speed) {
    const Grid grid{.size = size, .speeds = {}};
    const std::vector<double> speeds(static_cast<std::size_t>(grid.sample_count()), speed);
    EXPECT_TRUE(write_distances(folder() + name, grid, speeds));
    return folder() + name;
  }
  PictureData picture() const {
    return picture_of(session.explored(), session.state().shown, session.state().picture.view);
  }
};

TEST_F(SessionOnGrid, ASheetIsSeenHeadOnUnlessItWasTurned) {
  const auto camera = [this] { return session.state().picture.camera; };
  run({"open " + grid("sheet.vti", {30, 20, 1}, 1), "check off"});
  EXPECT_EQ(camera().azimuth, 0);
  EXPECT_EQ(camera().elevation, 0);
  EXPECT_NE(session.script().find("camera place 0 0 1 0 0\n"), std::string::npos)
      << session.script();

  run({"reset", "azimuth 70", "open " + grid("other.vti", {30, 20, 1}, 1)});
  EXPECT_EQ(camera().azimuth, 70);
  run({"reset", "open " + grid("upright.vti", {1, 30, 20}, 1)});
  EXPECT_EQ(camera().azimuth, 90) << "it lies across x";
  run({"reset", "open " + grid("box.vti", {5, 5, 5}, 1)});
  EXPECT_EQ(camera(), initial_state().picture.camera);
}

TEST_F(SessionOnGrid, ASheetThatWasTurnedBackIsSeenSoWhenReplayed) {
  const std::string opened = "open " + grid("sheet.vti", {30, 20, 1}, 1);
  const CameraSettings usual = initial_state().picture.camera;
  for (const std::string turned : {"camera place 30 20 1 0 0", "reset"}) {
    const std::string name = folder() + turned.substr(0, 5);
    Session first;
    for (const std::string& line : {opened, turned, "save log " + name + "_l.geotherm",
                                    "save session " + name + "_s.geotherm"}) {
      ASSERT_TRUE(first.submit(*parse_command(line))) << line;
    }
    EXPECT_EQ(first.state().picture.camera, usual);
    for (const char* kind : {"_l.geotherm", "_s.geotherm"}) {
      Session again;
      ASSERT_TRUE(again.submit(command::Run{name + kind}));
      EXPECT_EQ(again.state().picture.camera, usual) << turned << kind;
    }
  }
}

TEST_F(SessionOnGrid, ErrorsOfTheViewAreThoseOfTheCells) {
  constexpr double kSpeed = 2;
  run({"open " + grid("fast.vti", {30, 20, 1}, kSpeed), "check off", "source set 0",
       "view eikonal-error"});
  // The slope of travel time is half a unit a unit: as an error of the drawn triangles 0.5.
  std::vector<float> values = picture().face_values;
  ASSERT_EQ(std::ssize(values), 2 * 29 * 19);
  std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
  EXPECT_LT(values[values.size() / 2], 0.05);
  run({"view lost-gradients"});
  EXPECT_EQ(picture().face_title, "no heat direction (0\u00a0cells)");
  run({"view contours"});
  EXPECT_EQ(picture().value_title, "travel time (time\u00a0units)");

  // Inside a solid block distance runs into it: triangles of its outside see a part of that alone.
  run({"open " + grid("block.vti", {9, 9, 9}, 1), "method fast-marching", "source set 364",
       "view eikonal-error"});
  const auto shown = picture().face_values;
  ASSERT_EQ(shown.size(), 6U * 2 * 8 * 8);
  EXPECT_LT(std::ranges::max(shown), 0.02);
}

TEST_F(SessionOnGrid, DistancesAreSavedInItsOwnFiles) {
  run({"open " + grid("box.vti", {5, 6, 7}, 1), "check off", "source set 0",
       "save distances " + folder() + "d.vti"});
  const auto back = read_grid(folder() + "d.vti");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->grid.size, (std::array<Index, 3>{5, 6, 7}));
  const auto refused = session.submit(command::SaveDistances{folder() + "d.vtu"});
  ASSERT_FALSE(refused);
  EXPECT_NE(sentence(refused.error()).find("for a grid"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder() + "d.vtu"));
}

}  // namespace
}  // namespace geotherm::app
