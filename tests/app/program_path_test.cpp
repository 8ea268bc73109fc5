// SPDX-License-Identifier: MIT
// The commands path and isolines.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "app/cli/line_files.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

/// A square of side 2 in the plane z = 0, cut into four triangles about its middle, vertex 4.
constexpr const char* kSquare =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

TEST_F(Program, PathJsonHasTheKeysOfTheContract) {
  folder.write("square.obj", kSquare);
  const Json path = json({"path", "square.obj", "--from", "0", "--to", "2", "--json", "-"});
  expect_keys(path,
              keys({"from", "to", "length", "points", "faces", "barycentric", "field", "closed",
                    "method", "warnings"}),
              "");
  EXPECT_EQ(path["from"], 0);
  EXPECT_EQ(path["to"], 2);
  EXPECT_NEAR(path["length"].get<double>(), 2 * std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(path["points"].size(), path["faces"].size());
  EXPECT_EQ(path["points"].size(), path["barycentric"].size());
  EXPECT_EQ(path["points"].front(), Json({0.0, 0.0, 0.0}));
  EXPECT_EQ(path["points"].back(), Json({2.0, 2.0, 0.0}));
  EXPECT_EQ(path["field"], "geodesic");
  EXPECT_EQ(path["method"], "wavefront");
}

TEST_F(Program, PathTakesPointsOfEveryKind) {
  folder.write("square.obj", kSquare);
  const Json path = json(
      {"path", "square.obj", "--from", "face:0:0.5:0.5:0", "--to", "xyz:1:2:5", "--json", "-"});
  EXPECT_NEAR(path["length"].get<double>(), 2, 1e-12);
  EXPECT_EQ(path["from"]["face"], 0);
}

TEST_F(Program, PathToSeveralTargetsIsSeveralPaths) {
  folder.write("square.obj", kSquare);
  const Json both =
      json({"path", "square.obj", "--from", "0", "--to", "1", "--to", "2", "--json", "-"});
  ASSERT_EQ(both["paths"].size(), 2U);
  EXPECT_EQ(both["length"], both["paths"][0]["length"]);
  EXPECT_NEAR(both["paths"][0]["length"].get<double>(), 2, 1e-12);
  EXPECT_EQ(both["paths"][1]["to"], 2);
}

TEST_F(Program, PathGoesThroughWayPointsAndBack) {
  folder.write("square.obj", kSquare);
  const Json loop = json({"path", "square.obj", "--from", "0", "--via", "1", "--to", "2",
                          "--closed", "--hold", "--json", "-"});
  EXPECT_NEAR(loop["length"].get<double>(), 4 + 2 * std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(loop["closed"], true);
  EXPECT_EQ(loop["via"], Json({1}));
}

TEST_F(Program, PathFollowsDistanceAndHeat) {
  for (const char* field : {"distance", "heat"}) {
    const Json line =
        json({"path", "bunny", "--from", "10", "--to", "900", "--field", field, "--json", "-"});
    const Json best = json({"path", "bunny", "--from", "10", "--to", "900", "--json", "-"});
    EXPECT_EQ(line["field"], field);
    EXPECT_EQ(line["method"], "heat");
    EXPECT_GE(line["length"], best["length"]);
    EXPECT_LE(line["length"].get<double>(), 1.2 * best["length"].get<double>());
  }
}

TEST_F(Program, PathWritesEveryFormat) {
  folder.write("square.obj", kSquare);
  const ProgramRun table = run({"path", "square.obj", "--from", "0", "--to", "2", "-o", "a.obj",
                                "-o", "a.csv", "-o", "a.vtp", "-o", "a.svg"});
  EXPECT_NE(table.out.find("from vertex 0 to vertex 2"), std::string::npos) << table.out;
  EXPECT_EQ(bytes_of(folder.path("a.obj")), "v 0 0 0\nv 1 1 0\nv 2 2 0\nl 1 2\nl 2 3\n");
  EXPECT_TRUE(bytes_of(folder.path("a.csv")).starts_with("line,point,x,y,z,face,b0,b1,b2\n"));
  EXPECT_NE(bytes_of(folder.path("a.vtp")).find("NumberOfLines=\"1\""), std::string::npos);
  EXPECT_TRUE(bytes_of(folder.path("a.svg")).starts_with("<svg "));
  const ProgramRun csv = run({"path", "square.obj", "--from", "0", "--to", "2", "-o", "-"});
  EXPECT_EQ(csv.out, bytes_of(folder.path("a.csv")));
}

TEST_F(Program, PathSaysWhenItsPictureShowsNothingOfIt) {
  folder.write("square.obj", kSquare + std::string("v 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\n"
                                                   "f 6 7 8\nf 6 8 9\n"));
  const std::vector<std::string> path = {"path",        "square.obj",  "--from", "4",  "--to",
                                         "xyz:1:0.8:0", "--elevation", "0",      "-o", "a.svg"};
  auto behind = path, before = path;
  behind.insert(behind.end(), {"--azimuth", "0"});
  before.insert(before.end(), {"--azimuth", "180"});
  EXPECT_NE(run(behind).err.find("--azimuth"), std::string::npos);
  EXPECT_EQ(run(before).err, "");
}

TEST(LinePictures, HaveThatAxisUpWhichTheFileOfTheModelSays) {
  app::Model model;
  model.mesh = std::make_shared<const TriangleMesh>(*TriangleMesh::build(
      {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  const auto picture_with = [&](app::UpAxis of_file, app::UpAxis asked) {
    model.up = of_file;
    app::PictureSettings settings;
    settings.camera.up = asked;
    return app::line_picture_svg(app::picture_on(model, "no lines"), settings)->text;
  };
  using enum app::UpAxis;
  EXPECT_NE(picture_with(kAuto, kZ), picture_with(kAuto, kY));
  EXPECT_EQ(picture_with(kZ, kAuto), picture_with(kAuto, kZ));
  EXPECT_EQ(picture_with(kZ, kY), picture_with(kAuto, kY)) << "who asks decides";
}

TEST_F(Program, IsolinesAreReportedAndWritten) {
  folder.write("square.obj", kSquare);
  const Json lines =
      json({"isolines", "square.obj", "-s", "4", "--method", "wavefront", "--spacing", "0.5",
            "--json", "-", "-o", "lines.csv", "-o", "lines.svg"});
  ASSERT_EQ(lines["levels"], Json({0.5, 1.0}));
  ASSERT_EQ(lines["lines"].size(), 2U);
  for (const Json& line : lines["lines"]) {
    EXPECT_EQ(line["closed"], true);
    // A square with its corners on the diagonals.
    const double expected = 4 * std::numbers::sqrt2 * line["value"].get<double>();
    EXPECT_NEAR(line["length"].get<double>(), expected, 1e-9);
    EXPECT_EQ(line["points"], 5);
  }
  EXPECT_TRUE(
      bytes_of(folder.path("lines.csv")).starts_with("line,point,x,y,z,face,b0,b1,b2,value\n"));
  EXPECT_NE(bytes_of(folder.path("lines.svg")).find("</svg>"), std::string::npos);
}

TEST_F(Program, IsolinesByNumberAreEvenAndLeaveOutBothEnds) {
  const Json lines = json({"isolines", "bunny", "-s", "0", "--count", "4", "--json", "-"});
  ASSERT_EQ(lines["levels"].size(), 4U);
  const double first = lines["levels"][0];
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(lines["levels"][i].get<double>(), first * (i + 1), 1e-12 * first * (i + 1));
  }
  EXPECT_GE(lines["lines"].size(), 4U);
}

struct Refused {
  const char* name;
  std::vector<std::string> arguments;
  const char* part;  ///< of the message
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }

class ProgramRefusesLines : public testing::TestWithParam<Refused> {};

TEST_P(ProgramRefusesLines, InOneLineWithTheCure) {
  const TemporaryDirectory folder;
  folder.write("square.obj", kSquare);
  const ProgramRun result = run_program(folder.path("."), GetParam().arguments);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(result.err.starts_with("geotherm: error: ")) << result.err;
  EXPECT_NE(result.err.find(GetParam().part), std::string::npos) << result.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"square.obj"});
}

INSTANTIATE_TEST_SUITE_P(
    Table, ProgramRefusesLines,
    testing::Values(
        Refused{"NoFrom", {"path", "square.obj", "--to", "1"}, "--from"},
        Refused{"NoTo", {"path", "square.obj", "--from", "1"}, "--to"},
        Refused{
            "ManyPoints", {"path", "square.obj", "--from", "1,2", "--to", "3"}, "not one point"},
        Refused{"OutOfRange", {"path", "square.obj", "--from", "1", "--to", "99"}, "--to 99"},
        Refused{"OffsetAtTheEnd",
                {"path", "square.obj", "--from", "1", "--to", "2@1"},
                "--to: '2@1' has an offset"},
        Refused{"Field",
                {"path", "square.obj", "--from", "1", "--to", "2", "--field", "x"},
                "geodesic, distance, heat"},
        Refused{"HeatNeedsHeat",
                {"path", "square.obj", "--from", "1", "--to", "2", "--field", "heat", "--method",
                 "wavefront"},
                "method heat"},
        Refused{"ClosedTwice",
                {"path", "square.obj", "--from", "1", "--to", "2", "--to", "3", "--closed"},
                "--via"},
        Refused{
            "HoldAlone", {"path", "square.obj", "--from", "1", "--to", "2", "--hold"}, "--closed"},
        Refused{"Ending",
                {"path", "square.obj", "--from", "1", "--to", "2", "-o", "a.ply"},
                ".obj .csv .vtp .svg"},
        Refused{"NoSpacing", {"isolines", "square.obj", "-s", "1"}, "none of them"},
        Refused{"BothSpacings",
                {"isolines", "square.obj", "-s", "1", "--spacing", "1", "--count", "2"},
                "two of them"},
        Refused{"ZeroSpacing", {"isolines", "square.obj", "-s", "1", "--spacing", "0"}, "above 0"},
        Refused{"TinySpacing",
                {"isolines", "square.obj", "-s", "1", "--spacing", "1e-9"},
                "give a larger one"},
        Refused{"NoSource", {"isolines", "square.obj", "--count", "3"}, "no source"}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace geotherm::test
