// SPDX-License-Identifier: MIT
// Many sources: rows, pairs, samples.
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <sstream>

#include "app/many/many_work.h"
#include "solver/mesh/write_distances.h"
#include "tests/app/program_fixture.h"
#include "tests/support/compare.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

template <class Number>
std::vector<Number> npy_values(const std::string& bytes) {
  if (bytes.size() < 10) return {};
  const std::size_t header = 10 + static_cast<unsigned char>(bytes[8]) +
                             256 * std::size_t{static_cast<unsigned char>(bytes[9])};
  std::vector<Number> values((bytes.size() - header) / sizeof(Number));
  std::memcpy(values.data(), bytes.data() + header, values.size() * sizeof(Number));
  return values;
}

/// Of the largest distance: several sources are solved as one block, which rounds otherwise.
constexpr double kRoundOff = 1e-12;

bool has_shape(const std::string& bytes, std::size_t rows, std::size_t columns) {
  return bytes.find("'shape': (" + std::to_string(rows) + ", " + std::to_string(columns) + "), ") !=
         std::string::npos;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(Program, EachWritesTheRowsOfSingleSolvesInTheOrderOfTheSources) {
  const Json report = json({"solve", "bunny", "-s", "900,3", "-s", "random:2:5", "-s", "900", "-s",
                            "face:7:0.2:0.3:0.5", "--each", "-o", "rows.npy", "--json", "-"});
  ASSERT_EQ(report["sources"].size(), 6U);
  EXPECT_EQ(report["sources"][0], 900);
  EXPECT_EQ(report["sources"][1], 3);
  EXPECT_EQ(report["sources"][4], 900);
  const std::string bytes = bytes_of(folder.path("rows.npy"));
  const std::size_t vertices = report["model"]["vertices"];
  EXPECT_TRUE(has_shape(bytes, 6, vertices));
  const auto rows = npy_values<double>(bytes);
  ASSERT_EQ(rows.size(), 6 * vertices);
  for (std::size_t i = 0; i < 6; ++i) {
    const Json& source = report["sources"][i];
    const std::string text = source.is_number() ? source.dump() : "face:7:0.2:0.3:0.5";
    run({"solve", "bunny", "-s", text, "-o", "one.npy"});
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(i * vertices);
    EXPECT_LE(relative_difference({begin, begin + static_cast<std::ptrdiff_t>(vertices)},
                                  npy_values<double>(bytes_of(folder.path("one.npy")))),
              kRoundOff)
        << text;
  }
  expect_keys(report,
              {{"model", keys({"name", "vertices", "faces"})},
               {"options", keys({"method", "backend", "t", "threads"})},
               {"rows", nullptr},
               {"columns", nullptr},
               {"dtype", nullptr},
               {"distance", keys({"min", "max", "mean", "unreached"})},
               {"timing_ms", keys({"load", "setup", "queries", "query"})},
               {"memory_mb", keys({"factor", "answers", "peak_rss"})},
               {"warnings", nullptr}},
              "");
}

TEST_F(Program, EachHasTheBitsOfSingleSolvesByMethodsWithoutBlocks) {
  run({"solve", "bunny", "-s", "5,900", "--each", "-o", "a.npy", "--method", "wavefront"});
  const auto rows = npy_values<double>(bytes_of(folder.path("a.npy")));
  run({"solve", "bunny", "-s", "900", "-o", "b.npy", "--method", "wavefront"});
  const auto single = npy_values<double>(bytes_of(folder.path("b.npy")));
  ASSERT_EQ(rows.size(), 2 * single.size());
  EXPECT_TRUE(std::equal(single.begin(), single.end(),
                         rows.begin() + static_cast<std::ptrdiff_t>(single.size())));
}

TEST_F(Program, EachIsTheSameOnStandardOutputAndForAnyThreads) {
  run({"solve", "bunny", "-s", "random:40", "--each", "-o", "rows.npy", "--threads", "1"});
  const ProgramRun streamed =
      run({"solve", "bunny", "-s", "random:40", "--each", "-o", "-", "--threads", "3"});
  EXPECT_EQ(streamed.out, bytes_of(folder.path("rows.npy")));
}

TEST_F(Program, EachRoundsToFloatsWhereAsked) {
  run({"solve", "bunny", "-s", "1,2", "--each", "-o", "a.npy"});
  run({"solve", "bunny", "-s", "1,2", "--each", "-o", "b.npy", "--float32"});
  run({"solve", "bunny", "-s", "1,2", "--each", "-o", "c.npy", "--dtype", "float32"});
  const auto exact = npy_values<double>(bytes_of(folder.path("a.npy")));
  const std::string rounded = bytes_of(folder.path("b.npy"));
  EXPECT_NE(rounded.find("'<f4'"), std::string::npos);
  EXPECT_EQ(rounded, bytes_of(folder.path("c.npy")));
  const auto floats = npy_values<float>(rounded);
  ASSERT_EQ(floats.size(), exact.size());
  for (std::size_t i = 0; i < floats.size(); ++i) {
    EXPECT_EQ(floats[i], static_cast<float>(exact[i])) << i;
  }
}

TEST_F(Program, EachKeepsTheUnreachedInfiniteAndSaysWhy) {
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n");
  const ProgramRun done = run({"solve", "two.obj", "-s", "0,4", "--each", "-o", "a.npy"});
  EXPECT_NE(done.err.find("6 distances are infinite"), std::string::npos) << done.err;
  const auto rows = npy_values<double>(bytes_of(folder.path("a.npy")));
  ASSERT_EQ(rows.size(), 12U);
  for (std::size_t v = 0; v < 6; ++v) {
    EXPECT_EQ(std::isinf(rows[v]), v >= 3);
    EXPECT_EQ(std::isinf(rows[6 + v]), v < 3);
  }
}

TEST_F(Program, EachThatIsInterruptedLeavesNothing) {
  constexpr int kMostLooks = 20'000, kBetweenLooks = 1000;  // microseconds
  folder.write("rows.npy", "old");
  const RunningProgram program(
      folder.path("."), {"solve", "terrain", "-s", "random:5000", "--each", "-o", "rows.npy"});
  const auto begun = [&] {
    const auto names = folder.names();
    return std::ranges::any_of(
        names, [](const std::string& name) { return name.find(".tmp-") != name.npos; });
  };
  for (int look = 0; look < kMostLooks && !begun(); ++look) ::usleep(kBetweenLooks);
  ASSERT_TRUE(begun());
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 128 + SIGINT);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"rows.npy"});
  EXPECT_EQ(bytes_of(folder.path("rows.npy")), "old");
}

TEST(CancelledEach, LeavesNothing) {
  const TemporaryDirectory folder;
  app::SolveArguments arguments;
  arguments.model = "bunny";
  arguments.sources.sources = {"random:500"};
  arguments.outputs = {folder.path("a.npy")};
  arguments.each = true;
  int calls = 0;
  const auto result = app::run_solve(arguments, [&](std::string_view stage, double) {
    return stage.find("500 sources") == std::string_view::npos || ++calls < 3;
  });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(RoomForMany, IsAskedBeforeTheWork) {
  constexpr double kMoreThanAnyDisk = 1e24;
  const TemporaryDirectory folder;
  EXPECT_TRUE(app::check_room(folder.path("a.npy"), 1));
  EXPECT_TRUE(app::check_room("-", kMoreThanAnyDisk));
  const auto refused = app::check_room(folder.path("a.npy"), kMoreThanAnyDisk);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadFile);
  for (const char* part : {"a.npy: the file would take 1e+12 TB", "are free there; take fewer"}) {
    EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
  }
}

TEST(Estimate, IsToldOnceWhereMoreThanASecondIsLeft) {
  std::vector<std::string> told;
  const auto progress = app::with_estimate(
      {}, [&](const std::string& text) { told.push_back(text); }, "rows", "9 sources", "a file");
  EXPECT_TRUE(progress("solve", 0.9));  // the guess of a method
  EXPECT_TRUE(told.empty());
  EXPECT_TRUE(progress("rows", 1e-9));
  EXPECT_TRUE(progress("rows", 1e-9));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].starts_with("9 sources: about ") && told[0].ends_with(", a file")) << told[0];
  EXPECT_EQ(app::bytes_in_words(999'600'000), "1 GB");
  EXPECT_EQ(app::bytes_in_words(3.2e9), "3.2 GB");
  EXPECT_EQ(app::bytes_in_words(1), "1 byte");
  EXPECT_EQ(app::seconds_in_words(12.4), "12 s");
  EXPECT_EQ(app::seconds_in_words(200), "3 min 20 s");
  EXPECT_EQ(app::seconds_in_words(7500), "2 h 5 min");
}

/// On the unit sphere.
double great_circle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST_F(Program, PairsOnASphereAreGreatCircles) {
  constexpr double kChords = 0.01;  // an icosahedron's level 3 is inscribed: 2 % of an edge off
  const auto mesh = finish(sphere(3));
  ASSERT_TRUE(write_mesh(folder.path("sphere.ply"), *mesh));
  const Json report = json(
      {"solve", "sphere.ply", "-s", "random:12", "--pairs", "--method", "exact", "--json", "-"});
  const Json& vertices = report["sources"];
  ASSERT_EQ(report["distances"].size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) {
      const double expected = great_circle(mesh->positions()[vertices[i].get<Index>()],
                                           mesh->positions()[vertices[j].get<Index>()]);
      EXPECT_NEAR(report["distances"][i][j].get<double>(), expected, kChords * expected);
    }
  }
  constexpr double kExactIsAMetric = 1e-9;
  EXPECT_LT(report["asymmetry"]["max_of_distance"].get<double>(), kExactIsAMetric);
}

TEST_F(Program, PairsAreTheSameInEveryFileAndFromSingleSolves) {
  const Json report = json(
      {"solve", "bunny", "-s", "3,99,512", "--pairs", "-o", "a.csv", "-o", "a.npy", "--json", "-"});
  const auto matrix = npy_values<double>(bytes_of(folder.path("a.npy")));
  ASSERT_EQ(matrix.size(), 9U);
  EXPECT_TRUE(has_shape(bytes_of(folder.path("a.npy")), 3, 3));
  const auto lines = lines_of(bytes_of(folder.path("a.csv")));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "vertex,3,99,512");
  const double most = *std::ranges::max_element(matrix);
  double apart = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string from = std::vector<std::string>{"3", "99", "512"}[i];
    run({"solve", "bunny", "-s", from, "-o", "one.npy"});
    const auto single = npy_values<double>(bytes_of(folder.path("one.npy")));
    EXPECT_EQ(lines[i + 1].substr(0, from.size() + 1), from + ",");
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t to = std::vector<std::size_t>{3, 99, 512}[j];
      EXPECT_NEAR(matrix[3 * i + j], single[to], kRoundOff * most);
      EXPECT_EQ(report["distances"][i][j].get<double>(), matrix[3 * i + j]);
      apart = std::max(apart, std::abs(matrix[3 * i + j] - matrix[3 * j + i]));
    }
    EXPECT_EQ(matrix[3 * i + i], 0);
  }
  EXPECT_EQ(report["asymmetry"]["max"].get<double>(), apart);
  EXPECT_FALSE(report["symmetric"].get<bool>());
  EXPECT_EQ(run({"solve", "bunny", "-s", "3,99,512", "--pairs", "-o", "-"}).out,
            bytes_of(folder.path("a.csv")));
}

TEST_F(Program, SymmetricPairsAreTheMeanOfBothDirections) {
  const std::vector<std::string> words = {"solve",   "bunny",  "-s", "random:5",
                                          "--pairs", "--json", "-"};
  const Json report = json(words);
  std::vector<std::string> more = words;
  more.insert(more.end(), {"--symmetric", "-o", "a.npy"});
  const Json mean = json(more);
  EXPECT_EQ(mean["asymmetry"]["max"], report["asymmetry"]["max"]);
  EXPECT_GT(mean["asymmetry"]["max"].get<double>(), 0) << "of the heat method";
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < 5; ++j) {
      const double d = mean["distances"][i][j];
      EXPECT_EQ(d, mean["distances"][j][i].get<double>());
      const double both =
          report["distances"][i][j].get<double>() + report["distances"][j][i].get<double>();
      EXPECT_DOUBLE_EQ(d, both / 2);
    }
  }
}

TEST_F(Program, SampleReportsSamplesAndLabelsVertices) {
  const Json report = json({"sample", "bunny", "-n", "20", "-o", "cells.csv", "--samples",
                            "samples.csv", "--json", "-"});
  expect_keys(report,
              {{"model", keys({"name", "vertices", "faces"})},
               {"options", keys({"method", "backend", "t", "threads"})},
               {"count", nullptr},
               {"radius", nullptr},
               {"separation", nullptr},
               {"samples", nullptr},
               {"timing_ms", keys({"load", "setup", "sampling", "query"})},
               {"memory_mb", keys({"factor", "peak_rss"})},
               {"warnings", nullptr}},
              "");
  ASSERT_EQ(report["samples"].size(), 20U);
  const std::size_t vertices = report["model"]["vertices"];
  std::size_t cells = 0;
  for (const Json& sample : report["samples"]) cells += sample["cell"].get<std::size_t>();
  EXPECT_EQ(cells, vertices);
  EXPECT_GE(report["separation"].get<double>(), report["radius"].get<double>());

  const auto labels = lines_of(bytes_of(folder.path("cells.csv")));
  ASSERT_EQ(labels.size(), vertices + 1);
  EXPECT_EQ(labels[0], "vertex,distance,nearest_source");
  const auto list = lines_of(bytes_of(folder.path("samples.csv")));
  ASSERT_EQ(list.size(), 21U);
  EXPECT_EQ(list[0], "sample,vertex,x,y,z,distance,radius");
  for (std::size_t i = 0; i < 20; ++i) {
    const std::string vertex = report["samples"][i]["vertex"].dump();
    EXPECT_TRUE(list[i + 1].starts_with(std::to_string(i) + "," + vertex + ","));
    EXPECT_EQ(labels[1 + report["samples"][i]["vertex"].get<std::size_t>()],
              vertex + ",0," + std::to_string(i));
  }
}

TEST_F(Program, SampleWritesEveryFormatAndBeginsWhereItIsTold) {
  const ProgramRun shown = run({"sample", "bunny", "-n", "3", "--first", "7", "-o", "a.npy", "-o",
                                "a.ply", "-o", "a.vtp", "-o", "a.json", "--samples", "s.npy"});
  for (const char* part : {"radius", "separation", "sampling", "3 samples"}) {
    EXPECT_NE(shown.out.find(part), std::string::npos) << shown.out;
  }
  EXPECT_EQ(shown.err, "");
  const Json report = Json::parse(bytes_of(folder.path("a.json")));
  EXPECT_EQ(report["samples"][0]["vertex"], 7);
  EXPECT_TRUE(has_shape(bytes_of(folder.path("s.npy")), 3, 6));
  EXPECT_EQ(npy_values<double>(bytes_of(folder.path("s.npy")))[0], 7);
  EXPECT_TRUE(has_shape(bytes_of(folder.path("a.npy")), report["model"]["vertices"], 2));
  EXPECT_NE(bytes_of(folder.path("a.ply")).find("property int nearest_source"), std::string::npos);
}

TEST_F(Program, SampleIsInTheListOfCommands) {
  EXPECT_NE(run({"--help"}).out.find("sample"), std::string::npos);
  EXPECT_NE(run({"sample", "--help"}).out.find("geotherm sample bunny"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
