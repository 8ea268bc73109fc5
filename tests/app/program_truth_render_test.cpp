// SPDX-License-Identifier: MIT
// Pictures of errors, nearest sources and paths, through the built program.
#include <gtest/gtest.h>

#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class ProgramTruthRender : public DrawingProgram {
 protected:
  ProgramTruthRender() { run({"generate", "terrain", "--faces", "800", "-o", "small.ply"}); }

  Json picture(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", "small.ply", "--size", "320x240",
                                          "-o",     "p.png",     "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return json(arguments);
  }
  std::string bytes(const std::vector<std::string>& more) {
    picture(more);
    return bytes_of(folder.path("p.png"));
  }
};

TEST_F(ProgramTruthRender, ExactErrorHasItsRangeAndFigures) {
  const Json drawn = picture({"-s", "3", "--view", "exact-error"});
  EXPECT_EQ(drawn["picture"]["view"], "exact-error");
  EXPECT_EQ(drawn["error"]["reference"], "exact");
  const double low = drawn["picture"]["range"][0], high = drawn["picture"]["range"][1];
  EXPECT_EQ(low, -high) << "both signs are equally far from white";
  EXPECT_GE(high, drawn["error"]["max"].get<double>() * (1 - 1e-6));
}

TEST_F(ProgramTruthRender, RegionsDependOnTheSources) {
  EXPECT_NE(bytes({"-s", "3,400", "--view", "regions"}), bytes({"-s", "3", "--view", "regions"}));
}

TEST_F(ProgramTruthRender, PathsAreDrawn) {
  const std::string without = bytes({"-s", "3"});
  const std::string with = bytes({"-s", "3", "--path", "400"});
  EXPECT_NE(with, without);
  EXPECT_EQ(bytes({"-s", "3", "--path", "400"}), with) << "the same again";
}

TEST_F(ProgramTruthRender, SaysHowLongThePathsAre) {
  const Json drawn =
      picture({"-s", "3", "--path", "400", "--path-kind", "all"})["picture"]["paths"];
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_EQ(drawn[0]["field"], "geodesic");
  for (const Json& path : drawn) EXPECT_GE(path["length"], drawn[0]["length"]);
}

TEST_F(ProgramTruthRender, APathNeedsASourceAndOnePoint) {
  const auto fails = [this](const std::vector<std::string>& arguments) {
    const ProgramRun failed = run_program(folder.path("."), arguments);
    EXPECT_EQ(failed.code, 2) << failed.err;
    return failed.err;
  };
  EXPECT_NE(fails({"render", "small.ply", "--view", "smooth", "--path", "4", "-o", "x.png"})
                .find("--path"),
            std::string::npos);
  EXPECT_NE(fails({"render", "small.ply", "-s", "3", "--path", "4,5", "-o", "x.png"})
                .find("not one point"),
            std::string::npos);
}

TEST_F(ProgramTruthRender, ViewsOfHeatNeedTheHeatMethod) {
  const ProgramRun failed =
      run_program(folder.path("."), {"render", "small.ply", "-s", "3", "--method", "wavefront",
                                     "--view", "heat-gradient", "-o", "x.png"});
  EXPECT_EQ(failed.code, 2);
  EXPECT_NE(failed.err.find("--method heat"), std::string::npos) << failed.err;
}

}  // namespace
}  // namespace geotherm::test
