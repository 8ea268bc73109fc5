// SPDX-License-Identifier: MIT
// The commands logmap, trace, transport and extend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "geotherm/io.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// A square of side 2 in the plane z = 0, cut into four triangles about its middle, vertex 4, whose
/// first edge leads to vertex 0.
constexpr const char* kFlatSquare =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

TEST_F(Program, LogMapSaysWhereVerticesAreSeen) {
  folder.write("square.obj", kFlatSquare);
  const Json map = json({"logmap", "square.obj", "-s", "4", "--json", "-"});
  EXPECT_EQ(map["from"], 4);
  EXPECT_EQ(map["reached"], 5);
  EXPECT_EQ(map["frame"]["first"], 0);
  const double first = map["log_map"]["directions"][0];
  EXPECT_NEAR(first, 0, 1e-12);
  for (int v = 0; v < 4; ++v) {
    EXPECT_NEAR(map["log_map"]["distances"][v].get<double>(), std::numbers::sqrt2, 1e-12);
    const double turn = map["log_map"]["directions"][v].get<double>() - v * std::numbers::pi / 2;
    EXPECT_NEAR(std::remainder(turn, 2 * std::numbers::pi), 0, 1e-12) << v;
  }
}

TEST_F(Program, LogMapByWavesEndsWhereItIsTold) {
  const Json exact = json({"logmap", "bunny", "-s", "17", "--json", "-"});
  const Json near = json({"logmap", "bunny", "-s", "17", "--method", "wavefront-fine",
                          "--max-distance", "0.5", "--json", "-"});
  EXPECT_EQ(near["method"], "wavefront-fine");
  EXPECT_LT(near["reached"], exact["reached"]);
  for (std::size_t v = 0; v < exact["log_map"]["distances"].size(); ++v) {
    const double d = exact["log_map"]["distances"][v];
    if (d > 0.5) {
      EXPECT_TRUE(near["log_map"]["distances"][v].is_null()) << v;
    } else if (d < 0.499) {
      EXPECT_NEAR(near["log_map"]["distances"][v].get<double>(), d, 1e-3) << v;
    }
  }
  const Json at =
      json({"logmap", "bunny", "-s", "17", "--target", "900,3", "--target", "5", "--json", "-"});
  EXPECT_EQ(at["reached"], 3);
  EXPECT_EQ(at["log_map"]["directions"][900], exact["log_map"]["directions"][900]);
  expect_refused({"logmap", "bunny", "-s", "17", "--target", "5000"}, "--target");
  expect_refused({"logmap", "bunny", "-s", "17", "--method", "heat"}, "heat");
  expect_refused({"logmap", "bunny", "-s", "17", "--max-distance", "0"}, "--max-distance");
}

TEST_F(Program, LogMapWritesEveryFormat) {
  folder.write("square.obj", kFlatSquare);
  const ProgramRun table = run({"logmap", "square.obj", "-s", "4", "-o", "m.csv", "-o", "m.npy",
                                "-o", "m.ply", "-o", "m.svg"});
  EXPECT_NE(table.out.find("5 vertices"), std::string::npos) << table.out;
  EXPECT_TRUE(
      bytes_of(folder.path("m.csv")).starts_with("vertex,distance,direction,map_x,map_y\n0,1.41"));
  EXPECT_NE(bytes_of(folder.path("m.npy")).find("(5, 4)"), std::string::npos);
  EXPECT_NE(bytes_of(folder.path("m.ply")).find("property double map_y"), std::string::npos);
  EXPECT_NE(bytes_of(folder.path("m.svg")).find("<svg"), std::string::npos);
}

TEST_F(Program, TraceFollowsStraightestLines) {
  folder.write("square.obj", kFlatSquare);
  const Json lines = json({"trace", "square.obj", "--from", "4", "--direction", "0", "--direction",
                           "0.78539816339744831", "--length", "5", "--json", "-"});
  ASSERT_EQ(lines["traced"].size(), 2U);
  EXPECT_EQ(lines["traced"][0]["end"], "border");
  EXPECT_NEAR(lines["traced"][0]["length"].get<double>(), std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(lines["traced"][0]["to"], 0);
  EXPECT_NEAR(lines["traced"][1]["length"].get<double>(), 1, 1e-12);
  const Json fan = json({"trace", "square.obj", "--from", "4", "--fan", "7", "--length", "0.25",
                         "-o", "fan.vtp", "-o", "fan.svg", "--json", "-"});
  ASSERT_EQ(fan["traced"].size(), 7U);
  for (const Json& line : fan["traced"]) EXPECT_EQ(line["end"], "length");
}

TEST_F(Program, TransportAndExtendReachAllVertices) {
  folder.write("square.obj", kFlatSquare);
  const ProgramRun vectors = run({"transport", "square.obj", "--vector", "4:3:0", "-o", "-"});
  // Towards vertex 0 all over the plane.
  const std::string all = vectors.out;
  EXPECT_TRUE(all.starts_with("vertex,vx,vy,vz,u,v,e1x,e1y,e1z,e2x,e2y,e2z\n")) << all;
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 6);
  EXPECT_NE(all.find("-2.12132034355964"), std::string::npos) << all;
  const ProgramRun values =
      run({"extend", "square.obj", "--value", "0:7", "-o", "v.ply", "-o", "-"});
  EXPECT_EQ(values.out.substr(0, 13), "vertex,value\n");
  EXPECT_NE(bytes_of(folder.path("v.ply")).find("property double value"), std::string::npos);
  const Json said = json({"transport", "bunny", "--vector", "17:1:0", "--vector", "900:0:2",
                          "--backend", "cholmod", "-o", "bunny.svg", "--json", "-"});
  EXPECT_EQ(said["given"].size(), 2U);
  EXPECT_EQ(said["reached"], said["model"]["vertices"]);
  // Components along the axes are the vectors in space.
  for (const int v : {0, 17, 1234}) {
    for (int k = 0; k < 3; ++k) {
      const double sum =
          said["components"][v][0].get<double>() *
              said["tangent_frames"]["e1"][v][k].get<double>() +
          said["components"][v][1].get<double>() * said["tangent_frames"]["e2"][v][k].get<double>();
      EXPECT_NEAR(said["vectors"][v][k].get<double>(), sum, 1e-12) << v;
    }
  }
  EXPECT_EQ(bytes_of(folder.path("bunny.svg")).find("dasharray"), std::string::npos)
      << "arrows that the surface hides would lie over the others";
}

TEST_F(Program, WhatIsSpreadCanStandInAFile) {
  folder.write("vectors.txt", "# V X Y\n17 1 0\n900, 0, 2\n5:1:1\n");
  const Json said = json({"transport", "bunny", "--vectors", "vectors.txt", "--json", "-"});
  const Json same = json({"transport", "bunny", "--vector", "17:1:0", "--vector", "900:0:2",
                          "--vector", "5:1:1", "--json", "-"});
  EXPECT_EQ(said["vectors"], same["vectors"]);
  folder.write("values.txt", "17 1\n900\n");
  expect_refused({"extend", "bunny", "--values", "values.txt"},
                 "values.txt: line 2: '900' is no value at a vertex");
  expect_refused({"extend", "bunny"}, "--value");
}

TEST_F(Program, SignedDistanceKnowsTheSidesOfALoop) {
  folder.write("square.obj", kFlatSquare);
  const std::vector<std::string> loop = {"signed",    "square.obj",    "--through", "xyz:0.5:0.5:0",
                                         "--through", "xyz:1.5:0.5:0", "--through", "xyz:1.5:1.5:0",
                                         "--through", "xyz:0.5:1.5:0", "--closed"};
  auto words = loop;
  words.insert(words.end(), {"-o", "-"});
  const std::string csv = run(words).out;
  EXPECT_TRUE(csv.starts_with("vertex,distance\n0,0.7071067811865")) << csv;
  EXPECT_NE(csv.find("\n4,-0."), std::string::npos) << csv;
  words = loop;
  words.insert(words.end(), {"--json", "-", "-o", "signed.svg"});
  const Json said = json(words);
  EXPECT_EQ(said["rule"], "sides");
  EXPECT_NEAR(said["length"].get<double>(), 4, 1e-9);
  EXPECT_NEAR(said["range"][0].get<double>(), -0.5, 1e-9);
  const std::string picture = bytes_of(folder.path("signed.svg"));
  for (const char* colour : {"#588cdc", "#ec8246", "#780618", "#28303a"}) {
    EXPECT_NE(picture.find(colour), std::string::npos) << colour << ": both sides and the curve";
  }
  // Lines of other commands are curves, too; one that is open has no sides.
  run({"path", "square.obj", "--from", "xyz:0.5:0.5:0", "--to", "xyz:1.5:0.5:0", "-o", "p.csv"});
  const Json open = json({"signed", "square.obj", "--curves", "p.csv", "--json", "-"});
  EXPECT_EQ(open["rule"], "heat");
  EXPECT_EQ(open["warnings"].size(), 1U);
  expect_refused({"signed", "square.obj", "--curves", "p.csv", "--rule", "sides"},
                 "do not separate the surface");
  expect_refused({"signed", "square.obj", "--curves", "p.csv", "--rule", "luck"}, "luck");
  expect_refused({"signed", "square.obj", "--curves", "square.obj"}, "line 2 is no point");
  expect_refused({"signed", "square.obj"}, "--through");
}

/// A closed line ends in another face than it begins in, at the same place.
TEST_F(Program, IsolinesInFilesSeparateTheSurface) {
  run({"isolines", "bunny", "-s", "840", "--values", "0.3", "-o", "ring.csv"});
  const Json said = json({"signed", "bunny", "--curves", "ring.csv", "--json", "-"});
  EXPECT_EQ(said["rule"], "sides");
  EXPECT_EQ(said["warnings"].size(), 0U) << said["warnings"];
}

TEST_F(Program, CentreOfTheCornersIsTheMiddle) {
  folder.write("square.obj", kFlatSquare);
  folder.write("points.txt", "2  # by the file\nxyz:0:2:0\n");
  folder.write("weights.txt", "1 1\n1 1\n");
  const Json mean = json({"centre", "square.obj", "--of", "0,1", "--points", "points.txt",
                          "--weights", "weights.txt", "--json", "-"});
  EXPECT_EQ(mean["kind"], "mean");
  ASSERT_EQ(mean["centres"].size(), 1U);
  const Json& centre = mean["centres"][0];
  EXPECT_NEAR(centre["position"][0].get<double>(), 1, 1e-9);
  EXPECT_NEAR(centre["position"][1].get<double>(), 1, 1e-9);
  EXPECT_NEAR(centre["energy"].get<double>(), 2, 1e-9);
  EXPECT_EQ(centre["converged"], true);
  EXPECT_EQ(mean["of"].size(), 4U);
  // The corner with most of the weight is the median, and a quarter of the way from it the mean.
  const std::vector<std::string> two = {"centre",    "square.obj", "--of",   "0,2",
                                        "--weights", "3,1",        "--json", "-"};
  EXPECT_NEAR(json(two)["centres"][0]["position"][0].get<double>(), 0.5, 1e-9);
  auto median = two;
  median.insert(median.end(), {"--median", "-o", "ways.csv", "-o", "ways.svg"});
  EXPECT_EQ(json(median)["centres"][0]["point"], 0);
  EXPECT_NE(bytes_of(folder.path("ways.csv")).find("\n0,0,0,0,0,"), std::string::npos);
  const ProgramRun table = run({"centre", "square.obj", "--of", "0,2"});
  EXPECT_NE(table.out.find("mean"), std::string::npos) << table.out;
}

TEST_F(Program, OptionsOfPicturesAreSaidToBeUnusedWhereThereIsNone) {
  folder.write("square.obj", kFlatSquare);
  const std::vector<std::vector<std::string>> commands = {
      {"isolines", "square.obj", "-s", "0", "--count", "3", "-o", "a.csv"},
      {"path", "square.obj", "--from", "0", "--to", "2", "-o", "a.csv"},
      {"trace", "square.obj", "--from", "0", "--length", "1", "-o", "a.csv"},
      {"centre", "square.obj", "--of", "0,2", "-o", "a.csv"},
      {"logmap", "square.obj", "-s", "0", "-o", "a.csv"},
      {"signed", "square.obj", "--through", "0", "--through", "2", "-o", "a.csv"},
      {"transport", "square.obj", "--vector", "0:1:0", "-o", "a.csv"},
  };
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--title", "x", "--dpi", "90"});
    const std::string said = run(words).err;
    EXPECT_NE(said.find("--title"), std::string::npos) << words.front() << ": " << said;
    EXPECT_NE(said.find("not used: no output is a picture; add -o FILE.svg"), std::string::npos)
        << words.front() << ": " << said;
    words.insert(words.end(), {"-o", "a.svg"});
    EXPECT_EQ(run(words).err.find("no output is a picture"), std::string::npos) << words.front();
  }
  const std::string sides = run({"signed", "square.obj", "--through", "0", "--through", "2", "-m",
                                 "3", "--rule", "sides", "-o", "a.csv"})
                                .err;
  EXPECT_NE(sides.find("the rule sides does not use --time-factor"), std::string::npos) << sides;
}

TEST_F(Program, CentresThatCannotBeAreOneLine) {
  folder.write("square.obj", kFlatSquare);
  expect_refused({"centre", "square.obj"}, "--of");
  expect_refused({"centre", "square.obj", "--of", "99"}, "99");
  expect_refused({"centre", "square.obj", "--of", "boundary"}, "--of: point 0");
  expect_refused({"centre", "square.obj", "--of", "0,1", "--weights", "1"},
                 "--weights: 1 weight for 2 points");
  expect_refused({"centre", "square.obj", "--of", "0,1", "--weights", "1,x"}, "'x'");
  expect_refused({"centre", "square.obj", "--of", "0,1", "--method", "heat"}, "heat");
  expect_refused({"sample", "square.obj", "-n", "2", "--relax", "0"}, "--relax");
}

TEST_F(Program, RelaxedSamplesHaveTheEnergyOfEachStep) {
  const Json report = json({"sample", "bunny", "-n", "12", "--relax", "6", "--no-check", "-o",
                            "cells.csv", "--samples", "s.csv", "--json", "-"});
  const Json& relaxation = report["relaxation"];
  const auto energies = relaxation["energies"].get<std::vector<double>>();
  ASSERT_EQ(energies.size(), 7U);
  for (std::size_t i = 1; i < energies.size(); ++i) EXPECT_LT(energies[i], energies[i - 1]);
  EXPECT_EQ(relaxation["points"].size(), 12U);
  const std::string samples = bytes_of(folder.path("s.csv"));
  EXPECT_TRUE(samples.starts_with("sample,face,b0,b1,b2,x,y,z\n0,")) << samples;
  // Every vertex has the distance to the nearest of the moved ones.
  double sum = 0;
  for (const Json& point : relaxation["points"]) sum += point["cell"].get<double>();
  EXPECT_EQ(sum, report["model"]["vertices"].get<double>());
}

/// Two squares apart: what is given in one has no answer in the other.
TEST_F(Program, SpreadSaysWhatItDoesNotReach) {
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n");
  const ProgramRun map = run({"logmap", "two.obj", "-s", "0", "--json", "-"});
  EXPECT_NE(map.err.find("3 vertices lie in components without a source"), std::string::npos);
  const std::string said = "3 vertices lie in components without a given ";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"extend", "two.obj", "--value", "0:1", "--json", "-"},
        {"transport", "two.obj", "--vector", "0:1:0", "--json", "-"}}) {
    const ProgramRun result = run(words);
    EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
    EXPECT_NE(Json::parse(result.out)["warnings"].dump().find(said), std::string::npos);
  }
}

TEST_F(Program, SpreadRefusesContradictions) {
  folder.write("square.obj", kFlatSquare);
  const ProgramRun values =
      run_program(folder.path("."), {"extend", "square.obj", "--value", "0:1", "--value", "0:2"});
  EXPECT_EQ(values.code, 2);
  EXPECT_NE(values.err.find("--value 0:2: vertex 0 was given 1 and 2"), std::string::npos)
      << values.err;
  expect_refused({"transport", "square.obj", "--vector", "3:0:1", "--vector", "3:0:2"},
                 "--vector 3:0:2: vertex 3 was given 0:1 and 0:2");
  // What was merged is one vertex, and as much the command line's mistake.
  folder.write("apart.obj",
               "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3\nf 4 5 6\n");
  const ProgramRun merged = run_program(
      folder.path("."),
      {"extend", "apart.obj", "--weld", "0", "--value", "1:1", "--value", "0:4", "--value", "3:2"});
  EXPECT_EQ(merged.code, 2);
  EXPECT_NE(merged.err.find("--value 3:2: vertices 1 and 3, which are one, were given 1 and 2"),
            std::string::npos)
      << merged.err;
}

/// On the plane, where all of it can be worked out from the places that are written.
TEST_F(Program, RelaxedSamplesAreReportedWhereTheyAre) {
  constexpr double kRoundOff = 1e-9;
  ASSERT_TRUE(write_mesh(folder.path("plane.ply"), *finish(plane_grid(12, 12, 1, 1))));
  const Json report = json({"sample", "plane.ply", "-n", "5", "--relax", "20", "-o", "cells.npy",
                            "--samples", "s.npy", "--json", "-"});
  const auto rows = npy_values<double>(bytes_of(folder.path("s.npy")));
  const auto cells = npy_values<double>(bytes_of(folder.path("cells.npy")));
  ASSERT_EQ(rows.size(), 5U * 7U);  // face, weights, position
  double apart = 10, radius = 0;
  std::vector<double> radii(5, 0.0);
  for (std::size_t i = 0; i < 5; ++i) {
    const Json& sample = report["samples"][i];
    EXPECT_TRUE(sample["vertex"].is_null());
    EXPECT_EQ(sample["point"]["face"].get<double>(), rows[7 * i]);
    const Vec3 at(rows[7 * i + 4], rows[7 * i + 5], rows[7 * i + 6]);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(sample["position"][k].get<double>(), at[k]);
    for (std::size_t j = 0; j < i; ++j) {
      apart =
          std::min(apart, (at - Vec3(rows[7 * j + 4], rows[7 * j + 5], rows[7 * j + 6])).norm());
    }
  }
  for (std::size_t v = 0; v < cells.size(); v += 2) {
    radius = std::max(radius, cells[v]);
    double& of_cell = radii[static_cast<std::size_t>(cells[v + 1])];
    of_cell = std::max(of_cell, cells[v]);
  }
  EXPECT_NEAR(report["separation"].get<double>(), apart, kRoundOff);
  EXPECT_EQ(report["radius"].get<double>(), radius);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(report["samples"][i]["radius"].get<double>(), radii[i]);
  }
  const ProgramRun table = run({"sample", "plane.ply", "-n", "5", "--relax", "20"});
  EXPECT_NE(table.out.find("face"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("by distances of wavefront"), std::string::npos) << table.out;
}

TEST_F(Program, RelaxedSamplesAreSourcesOfOtherCommands) {
  run({"sample", "bunny", "-n", "12", "--relax", "2", "--no-check", "-o", "cells.npy", "--samples",
       "centres.txt"});
  run({"solve", "bunny", "--source-file", "centres.txt", "--method", "wavefront", "-o", "d.npy"});
  const auto cells = npy_values<double>(bytes_of(folder.path("cells.npy")));  // distance, nearest
  const auto d = npy_values<double>(bytes_of(folder.path("d.npy")));
  ASSERT_EQ(cells.size(), 2 * d.size());
  constexpr double kRoundOff = 1e-12;
  for (std::size_t v = 0; v < d.size(); ++v) EXPECT_NEAR(d[v], cells[2 * v], kRoundOff);
}

TEST_F(Program, SourcesThatAreMaskedOutAreSaidToBe) {
  folder.write("square.obj", kFlatSquare);
  folder.write("mask.txt", "0 0 1 0 0\n");
  expect_refused({"solve", "square.obj", "-s", "2", "--mask", "mask.txt"},
                 "that a mask leaves out");
}

TEST_F(Program, DirectionsThatCannotBeAreOneLine) {
  folder.write("square.obj", kFlatSquare);
  folder.write("strip.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  expect_refused({"logmap", "square.obj", "-s", "0,1"}, "not one point");
  expect_refused({"logmap", "square.obj", "-s", "99"}, "99");
  expect_refused({"logmap", "square.obj", "-s", "4", "-o", "map.xyz"}, ".csv .npy .ply .svg");
  expect_refused({"logmap", "strip.obj", "-s", "0"}, "no single fan");
  expect_refused({"trace", "square.obj", "--from", "0", "--direction", "-1", "--length", "1"},
                 "leaves the surface");
  expect_refused({"trace", "square.obj", "--from", "0", "--direction", "east", "--length", "1"},
                 "east");
  for (const char* count : {"0", "100000000"}) {
    expect_refused({"trace", "square.obj", "--from", "0", "--fan", count, "--length", "1"},
                   "give 1 to 1000000");
  }
  expect_refused({"transport", "square.obj", "--vector", "4:1"}, "VERTEX:X:Y");
  expect_refused({"transport", "square.obj", "--vector", "4:1:x"}, "VERTEX:X:Y");
  expect_refused({"transport", "square.obj", "--vector", "77:1:0"}, "77");
  expect_refused({"transport", "square.obj", "--vector=-1:1:0"}, "VERTEX:X:Y");
  expect_refused({"transport", "strip.obj", "--vector", "0:1:0"}, "no oriented manifold");
  expect_refused({"signed", "strip.obj", "--through", "2", "--through", "3"},
                 "do not separate the surface into what is left and right of them, and the signed "
                 "heat method needs an oriented manifold");
  expect_refused({"extend", "square.obj", "--value", "4"}, "VERTEX:VALUE");
}

}  // namespace
}  // namespace geotherm::test
