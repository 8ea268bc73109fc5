// SPDX-License-Identifier: MIT
// Models that are grids: mazes from pictures, arrays of NumPy, scans.
#include <algorithm>
#include <cmath>

#include "geotherm/domains.h"
#include "solver/mesh/io/format_writers.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

/// An array of bytes of NumPy.
std::string npy_of_bytes(const std::vector<std::uint64_t>& shape, const std::string& values) {
  return io::npy_header("|u1", shape) + values;
}

class ProgramOnGrids : public Program {
 protected:
  static constexpr Index kWidth = 60, kHeight = 40;
  static Index number(Index x, Index y) { return x + kWidth * y; }

  /// A wall across the middle row but for its last ten columns.
  void SetUp() override {
    std::string values(kWidth * kHeight, '\1');
    for (Index x = 0; x < kWidth - 10; ++x) values[number(x, 20)] = 0;
    folder.write("maze.npy", npy_of_bytes({kHeight, kWidth}, values));
    folder.write("box.npy", npy_of_bytes({9, 10, 11}, std::string(990, '\7')));
  }

  std::vector<double> distances(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"solve", "maze.npy", "-o", "d.npy"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(arguments);
    return npy_values<double>(bytes_of(folder.path("d.npy")));
  }
};

TEST_F(ProgramOnGrids, DistanceGoesRoundTheWall) {
  // From the left above the wall to the left below it: to its end, over it, and back.
  const double exact = std::hypot(50, 20) + 2 * std::hypot(0, 0) + std::hypot(50, 19);
  for (const std::string method : {"heat", "fast-marching"}) {
    const auto found = distances({"-s", "sample:0:0", "--method", method});
    ASSERT_EQ(found.size(), static_cast<std::size_t>(kWidth * kHeight));
    constexpr double kPassage = 2;  // through the end of the wall
    EXPECT_NEAR(found[number(0, 39)], exact + kPassage, 0.02 * exact) << method;
    EXPECT_EQ(found[number(3, 20)], kUnreached) << method;
  }
  EXPECT_NE(bytes_of(folder.path("d.npy")).find("'shape': (40, 60), }"), std::string::npos);
}

TEST_F(ProgramOnGrids, WhatTheyAreIsSaid) {
  const Json model = json({"info", "box.npy", "--json", "-"})["model"];
  EXPECT_EQ(model["domain"], "grid");
  EXPECT_EQ(model["size"], Json::array({11, 10, 9}));
  EXPECT_EQ(model["cells"], 10 * 9 * 8);
  EXPECT_EQ(model["vertices"], 990);
  EXPECT_EQ(model["drawn"]["faces"], 2 * 2 * (10 * 9 + 9 * 8 + 10 * 8));
  EXPECT_EQ(model["drawn"]["boundary_edges"], 0) << "the outside is closed";
  const ProgramRun told = run({"info", "maze.npy"});
  EXPECT_NE(told.out.find("60 x 40 samples every 1 x 1, of which 2,350 pass"), std::string::npos)
      << told.out;
  EXPECT_NE(told.out.find("0 is wall, all else passes"), std::string::npos) << told.out;
}

TEST_F(ProgramOnGrids, WallsAreMeantAndRoomsWithoutASourceAreSaid) {
  EXPECT_EQ(run({"solve", "maze.npy", "-s", "sample:0:0"}).err.find("infinite"), std::string::npos);
  std::string rooms(kWidth * kHeight, '\1');
  for (Index y = 0; y < kHeight; ++y) rooms[number(9, y)] = 0;
  folder.write("rooms.npy", npy_of_bytes({kHeight, kWidth}, rooms));
  const ProgramRun solved = run({"solve", "rooms.npy", "-s", "sample:30:20"});
  EXPECT_NE(solved.err.find("360 vertices are in no cell that a source reaches"), std::string::npos)
      << solved.err;
}

TEST_F(ProgramOnGrids, HeatIsHeldAgainstFastMarching) {
  const Json report = json({"solve", "maze.npy", "-s", "random:2:5", "--check", "--json", "-"});
  EXPECT_EQ(report["error"]["reference"], "fast-marching");
  EXPECT_LE(report["error"]["mean_relative"].get<double>(), 0.03);
}

TEST_F(ProgramOnGrids, SourcesAreSamplesPlacesAndTheBoundary) {
  const auto named = distances({"-s", "sample:30:5", "--method", "fast-marching"});
  EXPECT_EQ(named, distances({"-s", std::to_string(number(30, 5)), "--method", "fast-marching"}));
  EXPECT_EQ(named, distances({"-s", "xyz:30:5:0", "--method", "fast-marching"}));
  const auto between = distances({"-s", "xyz:30.5:5.5:0", "--method", "fast-marching"});
  EXPECT_NEAR(between[number(30, 5)], std::sqrt(0.5), 1e-12);
  const auto depth = distances({"-s", "boundary", "--method", "fast-marching"});
  EXPECT_NEAR(depth[number(30, 7)], 7, 1e-9) << "to the rim, as far as to the wall's nearer side";
  EXPECT_EQ(depth[number(30, 0)], 0);
}

TEST_F(ProgramOnGrids, RowsAndPairsAreThoseOfOneSource) {
  run({"solve", "maze.npy", "-s", "5", "-s", "900", "--each", "-o", "rows.npy"});
  const auto rows = npy_values<double>(bytes_of(folder.path("rows.npy")));
  const auto one = distances({"-s", "900"});
  constexpr double kBlocks = 1e-9;  // blocks of two columns round otherwise
  for (std::size_t v = 0; v < one.size(); ++v) {
    if (one[v] == kUnreached) continue;
    EXPECT_NEAR(rows[one.size() + v], one[v], kBlocks);
  }
  run({"solve", "maze.npy", "-s", "5", "-s", "900", "--pairs", "-o", "pairs.csv"});
}

TEST_F(ProgramOnGrids, CompareHoldsBackendsAgainstFastMarching) {
  run({"compare", "maze.npy", "--backends", "native,cg", "--json", "rows.json"});
  const Json rows = Json::parse(bytes_of(folder.path("rows.json")))["rows"];
  ASSERT_EQ(rows.size(), 2U);
  for (const Json& row : rows) {
    EXPECT_EQ(row["cells"], json({"info", "maze.npy", "--json", "-"})["model"]["cells"]);
    EXPECT_EQ(row["error_reference"], "fast-marching") << row;
    EXPECT_LE(row["mean_error"].get<double>(), 0.05) << row;
  }
}

TEST_F(ProgramOnGrids, OptionsOfReadingDecide) {
  // The same bytes as speeds: seven times as fast.
  const double once = json({"solve", "box.npy", "-s", "0", "--json", "-"})["distance"]["max"];
  const double fast =
      json({"solve", "box.npy", "-s", "0", "--grid", "speeds", "--json", "-"})["distance"]["max"];
  EXPECT_NEAR(7 * fast, once, 1e-9 * once);
  expect_refused({"info", "bunny", "--domain", "grid"}, "unknown extension \".ply\"");
  expect_refused({"info", "bunny", "--grid", "mask"}, "asked of grids");
  expect_refused({"info", "maze.npy", "--domain", "tets"}, "unknown extension \".npy\"");
  expect_refused({"info", "maze.npy", "--format", "obj", "--domain", "grid"},
                 "of grids; there are .png");
}

TEST_F(ProgramOnGrids, WhatIsOfSurfacesIsRefusedInOneLine) {
  expect_refused({"path", "maze.npy", "--from", "0", "--to", "5", "-o", "p.obj"},
                 "paths are of triangle meshes, and maze is a grid of");
  expect_refused({"sample", "maze.npy", "-n", "3"}, "samples are of triangle meshes");
  expect_refused({"solve", "maze.npy", "-s", "0", "--method", "exact"}, "this is a grid");
  expect_refused({"solve", "maze.npy", "-s", "0", "--refine", "1"}, "refined");
  expect_refused({"solve", "maze.npy", "-s", "0", "--weld", "0"}, "welded vertices are");
  expect_refused({"solve", "maze.npy", "-s", "0", "-o", "d.vtu"}, "for a grid");
  expect_refused({"solve", "maze.npy", "-s", std::to_string(number(3, 20))}, "belongs to no cell");
  expect_refused({"solve", "maze.npy", "-s", "sample:60:0"}, "there is no sample 60 along x");
  expect_refused({"solve", "bunny", "-s", "sample:0:0"}, "of grids alone");
}

TEST_F(ProgramOnGrids, DistancesReadBackFromVti) {
  run({"solve", "box.npy", "-s", "0", "-o", "d.vti"});
  const auto back = read_grid(folder.path("d.vti"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->grid.size, (std::array<Index, 3>{11, 10, 9}));
  expect_refused({"solve", "bunny", "-s", "0", "-o", "d.vti"},
                 "holds a grid, and bunny is a surface");
}

class DrawingProgramOnGrids : public DrawingProgram {};

TEST_F(DrawingProgramOnGrids, AGridIsDrawnByItsSquares) {
  folder.write("box.npy", npy_of_bytes({20, 30}, std::string(600, '\1')));
  run({"render", "box.npy", "-s", "0", "--size", "200x150", "-o", "box.png"});
  EXPECT_FALSE(bytes_of(folder.path("box.png")).empty());
  run({"isolines", "box.npy", "-s", "0", "--count", "4", "-o", "lines.obj"});
}

}  // namespace
}  // namespace geotherm::test
