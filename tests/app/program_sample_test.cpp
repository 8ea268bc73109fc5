// SPDX-License-Identifier: MIT
// Distances between vertices, and samples.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geotherm/backend.h"
#include "geotherm/io.h"
#include "tests/app/npy_file.h"
#include "tests/app/program_fixture.h"
#include "tests/support/shapes.h"

namespace geotherm::test {
namespace {

/// The tolerance is a share of the largest distance: several sources are solved as one block, which
/// rounds otherwise.
constexpr double kRoundOffOfDistances = 1e-12;

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
      EXPECT_NEAR(matrix[3 * i + j], single[to], kRoundOffOfDistances * most);
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
  double least = report["samples"][1]["distance"];
  for (std::size_t i = 1; i < 20; ++i) {
    least = std::min({least, report["samples"][i]["distance"].get<double>(),
                      report["samples"][i]["distance_back"].get<double>()});
  }
  EXPECT_EQ(report["separation"].get<double>(), least);

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
  const ProgramRun shown =
      run({"sample", "bunny", "-n", "3", "--first", "7", "-o", "a.npy", "-o", "a.ply", "-o",
           "a.vtp", "-o", "a.json", "--samples", "s.npy", "--no-check"});
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

TEST_F(Program, SampleNamesTheBackendThatAnswered) {
  const std::string asked = backend_names().front();
  const std::vector<std::string> words = {"sample", "bunny", "-n", "3", "-o", "a.json"};
  EXPECT_NE(run(words).out.find("heat, " + asked + ", "), std::string::npos);
  EXPECT_EQ(Json::parse(bytes_of(folder.path("a.json")))["options"]["backend"], asked);
  std::vector<std::string> limited = words;
  limited.insert(limited.end(), {"--memory-limit", "0.2"});
  EXPECT_NE(run(limited).out.find("heat, cg, "), std::string::npos);
  const Json options = Json::parse(bytes_of(folder.path("a.json")))["options"];
  EXPECT_EQ(options["backend"], "cg");
  EXPECT_EQ(options["backend_asked"], asked);
  EXPECT_EQ(options["fallbacks"].size(), backend_names().size() - 1);
}

TEST_F(Program, SampleIsInTheListOfCommands) {
  EXPECT_NE(run({"--help"}).out.find("sample"), std::string::npos);
  EXPECT_NE(run({"sample", "--help"}).out.find("geotherm sample bunny"), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
