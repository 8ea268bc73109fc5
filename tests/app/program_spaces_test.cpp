// SPDX-License-Identifier: MIT
// What is said and written of volumes, grids and polygons: figures of the space, not of what is
// drawn of it, and what other files with their extensions hold.
#include <algorithm>

#include "geotherm/domains.h"
#include "solver/mesh/io/format_writers.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"
#include "tests/support/dice.h"

namespace geotherm::test {
namespace {

std::string bytes_array(const std::vector<std::uint64_t>& shape, const std::string& values) {
  return io::npy_header("|u1", shape) + values;
}

class ProgramOnSpaces : public Program {
 protected:
  /// A corridor one sample wide and 40 long, that turns.
  void write_corridor() {
    std::string values(40 * 40, '\0');
    for (std::size_t k = 0; k < 40; ++k) values[k] = values[39 + 40 * k] = '\1';
    folder.write("corridor.npy", bytes_array({40, 40}, values));
  }
  /// Samples that are twice as fast in the right half.
  void write_speeds() {
    std::vector<double> speeds(30 * 20, 1);
    for (std::size_t v = 0; v < speeds.size(); ++v) speeds[v] = v % 30 < 15 ? 1 : 2;
    Grid grid;
    grid.size = {30, 20, 1};
    ASSERT_TRUE(write_distances(folder.path("speeds.vti"), grid, speeds));
  }
  void write_squares() {
    folder.write("squares.obj",
                 "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 0 0\n"
                 "f 1 2 5 4\nf 2 3 6 5\nf 3 7 6\n");
  }
};

TEST_F(ProgramOnSpaces, BoundsAreSaidWhereTheyAreLookedAt) {
  write_speeds();
  const ProgramRun timed = run({"solve", "speeds.vti", "-s", "0", "--json", "figures.json"});
  EXPECT_EQ(timed.out.find("bounds"), std::string::npos) << timed.out;
  EXPECT_NE(timed.out.find("travel time  0 to"), std::string::npos) << timed.out;
  EXPECT_NE(timed.out.find("mean time between samples h"), std::string::npos) << timed.out;
  const Json quality = Json::parse(bytes_of(folder.path("figures.json")))["quality"];
  EXPECT_TRUE(quality["below_straight_line"].is_null());
  EXPECT_TRUE(quality["steep_edges"].is_null());

  run({"generate", "ball-tets", "--tets", "2000", "-o", "ball.mesh"});
  EXPECT_NE(run({"solve", "ball.mesh", "-s", "0"}).out.find("no vertex below the straight line"),
            std::string::npos);
  const Json mesh = json({"solve", "bunny", "-s", "0", "--json", "-"})["quality"];
  EXPECT_EQ(mesh["below_straight_line"], 0);
  EXPECT_EQ(mesh["steep_edges"], 0);
}

TEST_F(ProgramOnSpaces, WarningsNameMethodsThatThereAre) {
  folder.write("box.npy", bytes_array({9, 10, 11}, std::string(990, '\1')));
  const ProgramRun wrong = run({"solve", "box.npy", "-s", "0", "--time-factor", "3000"});
  EXPECT_NE(wrong.err.find("below the straight line"), std::string::npos) << wrong.err;
  EXPECT_EQ(wrong.err.find("wavefront"), std::string::npos) << wrong.err;
  const ProgramRun rows = run({"solve", "box.npy", "-s", "0,5", "--each", "--no-check", "-o",
                               "rows.npy", "--time-factor", "3000"});
  EXPECT_NE(rows.err.find("use --method fast-marching"), std::string::npos) << rows.err;
  EXPECT_EQ(rows.err.find("wavefront"), std::string::npos) << rows.err;
}

TEST_F(ProgramOnSpaces, MistakesOfTheCommandLineNameWhatItTakes) {
  write_squares();
  write_corridor();
  run({"generate", "ball-tets", "--tets", "2000", "-o", "ball.mesh"});
  const std::pair<std::vector<std::string>, const char*> models[] = {
      {{"squares.obj", "--domain", "polygons"}, "wavefront"},
      {{"ball.mesh"}, "fast-marching"},
      {{"corridor.npy"}, "fast-marching"}};
  for (const auto& [model, method] : models) {
    std::vector<std::string> words = {"solve", "-s", "0@0.5"};
    words.insert(words.end(), model.begin(), model.end());
    const ProgramRun offset = run_program(folder.path("."), words);
    EXPECT_EQ(offset.code, 2);
    EXPECT_NE(offset.err.find(std::string("takes no offsets, and one is 0.5; use --method ") +
                              method + '\n'),
              std::string::npos)
        << offset.err;
    words.insert(words.end(), {"--method", method});
    EXPECT_EQ(run_program(folder.path("."), words).code, 0);
    words = {"solve", "-s", "0", "--constraint", "penalty:1e-300"};
    words.insert(words.end(), model.begin(), model.end());
    expect_refused(words, "; raise the penalty, or use --constraint pin-sources\n");
  }
}

TEST_F(ProgramOnSpaces, WhatIsBetterThanWavesOverPolygonsIsNamed) {
  write_squares();
  const auto said = [&](const std::string& method, const std::string& check) {
    return run({"solve", "squares.obj", "--domain", "polygons", "-s", "0", "--method", method,
                check})
        .out;
  };
  for (const char* const check : {"--quiet", "--check"}) {
    for (const char* const method : {"wavefront", "wavefront-fine"}) {
      const std::string words = said(method, check);
      EXPECT_NE(words.find(method + std::string(" is near exact; --method exact is exact\n")),
                std::string::npos)
          << words;
    }
    EXPECT_NE(said("exact", check).find("the most accurate method there is"), std::string::npos);
  }
}

TEST_F(ProgramOnSpaces, APlaceOfASourceThatIsNoVertexOfPolygonsSaysWhichStandsForIt) {
  folder.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const ProgramRun middle =
      run({"solve", "square.obj", "--domain", "polygons", "-s", "xyz:0.5:0.5:0", "--no-check"});
  EXPECT_NE(middle.err.find(", which stands for it, is 0.7071 away"), std::string::npos)
      << middle.err;
}

TEST_F(ProgramOnSpaces, ClosedPolygonsHaveNoBoundary) {
  folder.write("cube.obj",
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
               "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const ProgramRun none = run_program(
      folder.path("."), {"solve", "cube.obj", "--domain", "polygons", "-s", "boundary"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("has no boundary; choose vertices instead"), std::string::npos)
      << none.err;
}

TEST_F(ProgramOnSpaces, InfoOfPointsSaysNothingOfTheSidesOfFaces) {
  std::string points;
  Dice dice(4);
  for (int i = 0; i < 400; ++i) {
    const Vec3 p = dice.in_cube();
    points += std::to_string(p.x()) + ' ' + std::to_string(p.y()) + " 0\n";
  }
  folder.write("sheet.xyz", points);
  const ProgramRun info = run({"info", "sheet.xyz"});
  EXPECT_NE(info.out.find(" duplicate)"), std::string::npos) << info.out;
  EXPECT_EQ(info.out.find("turned against"), std::string::npos) << info.out;
}

TEST_F(ProgramOnSpaces, InfoHasTheFiguresOfTheSpace) {
  run({"generate", "box-tets", "--tets", "3000", "-o", "box.mesh"});
  const Json box = json({"info", "box.mesh", "--json", "-"})["model"];
  EXPECT_NEAR(box["volume"].get<double>(), 2 * 1.5 * 1, 1e-9);
  EXPECT_EQ(box["components"], 1);
  EXPECT_EQ(box["border_faces"], box["drawn"]["faces"]);
  EXPECT_EQ(box["slivers"], 0);
  EXPECT_GT(box["least_height_in_shortest_edges"], 0.5);
  EXPECT_FALSE(box.contains("faces"));
  // Euler's formula of a ball: V - E + F - T = 1, each tet having four faces.
  const auto whole = [&box](const char* key) { return box[key].get<int>(); };
  const int faces = (4 * whole("tets") + whole("border_faces")) / 2;
  EXPECT_EQ(whole("vertices") - whole("edges") + faces - whole("tets"), 1);

  write_corridor();
  const Json corridor = json({"info", "corridor.npy", "--json", "-"})["model"];
  EXPECT_EQ(corridor["squares"], 0);
  EXPECT_EQ(corridor["lone_edges"], 78);
  EXPECT_EQ(corridor["box_max"], Json::array({39, 39, 0}));
  EXPECT_EQ(corridor["walls"], 1600 - 79);
  EXPECT_EQ(corridor["components"], 1);
  write_speeds();
  const std::string speeds = run({"info", "speeds.vti"}).out;
  for (const char* says : {"551 squares, 0 edges alone", "1 to 2"}) {
    EXPECT_NE(speeds.find(says), std::string::npos) << speeds;
  }
  EXPECT_EQ(speeds.find("Delaunay"), std::string::npos) << speeds;

  write_squares();
  const Json squares =
      json({"info", "squares.obj", "--domain", "polygons", "--json", "-"})["model"];
  EXPECT_EQ(squares["polygons"], 3);
  EXPECT_EQ(squares["least_corners"], 3);
  EXPECT_EQ(squares["most_corners"], 4);
  EXPECT_EQ(squares["edges"], 9);
  EXPECT_EQ(squares["boundary_edges"], 7);
  EXPECT_NEAR(squares["area"].get<double>(), 2.5, 1e-12);
  folder.write("soup.obj",
               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n"
               "f 1 2 3 4\nf 5 6 7 8\n");
  const std::string soup = run({"info", "soup.obj", "--domain", "polygons"}).err;
  EXPECT_NE(soup.find("with --domain triangles, --weld 0 closes 2 of 8"), soup.npos) << soup;
}

TEST_F(ProgramOnSpaces, FieldsAreThoseOfTheirCells) {
  run({"generate", "ball-tets", "--tets", "2000", "-o", "ball.mesh"});
  const int tets = json({"info", "ball.mesh", "--json", "-"})["model"]["tets"];
  const std::vector<std::string> solve = {"solve", "ball.mesh", "-s", "0", "--fields"};
  const auto with = [&solve](std::vector<std::string> more) {
    more.insert(more.begin(), solve.begin(), solve.end());
    return more;
  };
  run(with({"eikonal-error,lost-gradients,error", "-o", "d.vtu", "-o", "d.ply"}));
  const std::string volume = bytes_of(folder.path("d.vtu"));
  EXPECT_NE(volume.find("NumberOfCells=\"" + std::to_string(tets) + '"'), std::string::npos);
  for (const char* name : {"eikonal_error", "lost_gradients", "\"error\""}) {
    EXPECT_NE(volume.find(name), std::string::npos) << name;
  }
  ASSERT_TRUE(read_tets(folder.path("d.vtu")));
  run(with({"all", "-o", "all.vtu"}));
  expect_refused(with({"non-delaunay", "-o", "e.vtu"}), "holds tets");
  expect_refused(with({"eikonal-error", "-o", "e.vti"}), "holds no field");
}

TEST_F(ProgramOnSpaces, WhatOtherFilesHoldIsSaid) {
  folder.write("a.vtu", "<VTKFile type=\"PolyData\" version=\"0.1\"></VTKFile>\n");
  expect_refused({"info", "a.vtu"}, "PolyData");
  folder.write("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n");
  expect_refused({"info", "a.vtk"}, "has no POINTS");
  folder.write("a.msh", "mesh version 1\n1 2 3\n");
  expect_refused({"info", "a.msh"}, "a.msh: line 1");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  expect_refused({"info", "flat.obj", "--domain", "polygons"}, "flat.obj: ");
  folder.write("line.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");
  expect_refused({"info", "line.xyz"}, "line.xyz: ");
  folder.write(
      "a.nhdr",
      "NRRD0004\ntype: uint8\ndimension: 2\nsizes: 3 2\nencoding: raw\ndata file: a.raw\n");
  folder.write("a.raw", "abc");
  expect_refused({"info", "a.nhdr"}, "a.raw: there are to be 6 samples");
}

TEST_F(ProgramOnSpaces, RegionsNameThePointsInCells) {
  run({"generate", "ball-tets", "--tets", "2000", "-o", "ball.mesh"});
  const Json regions = json({"solve", "ball.mesh", "-s", "xyz:0.1:0.2:0.3", "-s", "7", "--labels",
                             "--json", "-"})["regions"];
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0]["source"], 7);
  EXPECT_EQ(regions[1]["source"]["weights"].size(), 4U) << "those in cells come last";
}

/// Two rows of four vertices, in whichever order a curve and a point are given.
TEST_F(ProgramOnSpaces, RegionsOfPointsComeBeforeThoseOfCurves) {
  folder.write("strip.obj",
               "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\n"
               "f 1 2 5\nf 2 6 5\nf 2 3 6\nf 3 7 6\nf 3 4 7\nf 4 8 7\n");
  for (const auto& [first, second] : {std::pair("curve:0,4", "7"), std::pair("7", "curve:0,4")}) {
    const Json said = json({"solve", "strip.obj", "-s", first, "-s", second, "--method", "exact",
                            "--labels", "-o", "l.npy", "--json", "-"});
    EXPECT_EQ(said["regions"][0]["source"], 7);
    EXPECT_EQ(said["regions"][1]["source_edges"], 1);
    const auto rows = npy_values<double>(bytes_of(folder.path("l.npy")));
    for (int v = 0; v < 8; ++v) EXPECT_EQ(rows[2 * v + 1], v % 4 < 2 ? 1 : 0) << v;
  }
}

TEST_F(ProgramOnSpaces, IsolinesThatCannotBeThereAreSaid) {
  write_corridor();
  const ProgramRun lines = run({"isolines", "corridor.npy", "-s", "0", "--count", "3"});
  EXPECT_NE(lines.err.find("78 edges are alone"), std::string::npos) << lines.err;
  EXPECT_NE(lines.err.find("no triangle is crossed"), std::string::npos) << lines.err;
  const ProgramRun far = run({"isolines", "bunny", "-s", "0", "--spacing", "1000"});
  EXPECT_NE(far.err.find("the first level 1000"), std::string::npos) << far.err;
}

class DrawingProgramOnSpaces : public DrawingProgram {};

TEST_F(DrawingProgramOnSpaces, EmptyPicturesAreSaidAndSheetsSeenHeadOn) {
  folder.write("lone.npy", bytes_array({2, 2}, std::string("\1\1\0\0", 4)));
  const std::vector<std::string> small = {"--size", "120x90", "-o", "p.png", "--json", "p.json"};
  const auto drawn = [&](std::vector<std::string> words) {
    words.insert(words.end(), small.begin(), small.end());
    return run(words);
  };
  EXPECT_NE(drawn({"render", "lone.npy", "-s", "0"}).err.find("the picture is empty"),
            std::string::npos);
  folder.write("sheet.npy", bytes_array({20, 30}, std::string(600, '\1')));
  const ProgramRun sheet = drawn({"render", "sheet.npy", "-s", "0"});
  EXPECT_EQ(sheet.err.find("empty"), std::string::npos) << sheet.err;
  EXPECT_NE(sheet.out.find("sheet, 551 cells"), std::string::npos) << sheet.out;
  const auto camera = [this] {
    return Json::parse(bytes_of(folder.path("p.json")))["picture"]["camera"];
  };
  EXPECT_EQ(camera()["azimuth"], 0);
  EXPECT_EQ(camera()["elevation"], 0);
  drawn({"render", "sheet.npy", "-s", "0", "--azimuth", "25"});
  EXPECT_EQ(camera()["azimuth"], 25);
  EXPECT_EQ(camera()["elevation"], 20);
  folder.write("save.geotherm", "save session s.geotherm\n");
  run({"view", "sheet.npy", "--azimuth", "30", "--elevation", "20", "--script", "save.geotherm",
       "--headless"});
  EXPECT_NE(bytes_of(folder.path("s.geotherm")).find("camera place 30 20 1"), std::string::npos)
      << "the usual view, where that is asked for";
  const ProgramRun peeled = drawn({"render", "bunny", "-s", "0", "--peel", "above:1"});
  EXPECT_NE(peeled.err.find("the picture is empty: no cell"), std::string::npos) << peeled.err;
}

}  // namespace
}  // namespace geotherm::test
