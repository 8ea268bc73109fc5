// SPDX-License-Identifier: MIT
// Methods and how wrong they are, through the built program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "app/cli/study.h"
#include "geotherm/backend.h"
#include "geotherm/distance_method.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class ProgramTruth : public Program {
 protected:
  ProgramTruth() { run({"generate", "terrain", "--faces", "800", "-o", "small.ply"}); }
};

TEST_F(ProgramTruth, EveryMethodHasAllKeysOfSolve) {
  for (const std::string& name : all_names<MethodKind>()) {
    const Json solved = json({"solve", "small.ply", "-s", "3", "--method", name, "--json", "-"});
    expect_keys(solved["options"],
                keys({"method", "backend", "time_step", "time_factor", "t", "constraint", "heat",
                      "boundary", "laplacian", "threads"}),
                name + " options.");
    expect_keys(
        solved["quality"],
        keys({"heat_residual", "poisson_residual", "max_source_distance", "eikonal_error_mean",
              "zero_gradient_faces", "iterations_heat", "iterations_poisson", "below_straight_line",
              "most_below_straight_line", "steep_edges", "steepest_edge"}),
        name + " quality.");
    EXPECT_EQ(solved["options"]["method"], name);
    EXPECT_EQ(solved["options"]["t"].is_null(), name != "heat");
    EXPECT_EQ(solved["distance"]["min"], 0.0);
    EXPECT_GT(solved["timing_ms"]["query"].get<double>(), 0);
  }
}

TEST_F(ProgramTruth, AnUnknownMethodIsTheCommandLinesFault) {
  const ProgramRun failed =
      run_program(folder.path("."), {"solve", "bunny", "-s", "0", "--method", "magic"});
  EXPECT_EQ(failed.code, 2);
  EXPECT_NE(failed.err.find("wavefront-fine"), std::string::npos) << failed.err;
}

TEST_F(ProgramTruth, CheckHoldsHeatAgainstExact) {
  const Json good = json({"solve", "small.ply", "-s", "3", "--check", "--json", "-"})["error"];
  expect_keys(good, keys({"reference", "mean_relative", "max_of_range", "verdict"}), "error.");
  EXPECT_EQ(good["reference"], "exact");
  EXPECT_GT(good["mean_relative"].get<double>(), 0);
  const Json poor = json({"solve", "small.ply", "-s", "3", "--check", "--time-factor", "1000",
                          "--json", "-"})["error"];
  EXPECT_GT(poor["mean_relative"], good["mean_relative"]);
  EXPECT_EQ(poor["verdict"].get<std::string>().rfind("poor", 0), 0U) << poor;
  const ProgramRun table = run({"solve", "small.ply", "-s", "3", "--check"});
  EXPECT_NE(table.out.find("against exact"), std::string::npos) << table.out;
}

TEST_F(ProgramTruth, OffsetsHoldSourcesBack) {
  const Json solved =
      json({"solve", "small.ply", "-s", "3,400@0.001", "--method", "wavefront", "--json", "-"});
  EXPECT_EQ(solved["source_offsets"], Json::array({0.001, 0.001}));
  const ProgramRun heat = run_program(folder.path("."), {"solve", "small.ply", "-s", "3@0.5"});
  EXPECT_NE(heat.code, 0);
  EXPECT_NE(heat.err.find("--method wavefront"), std::string::npos) << heat.err;
  const ProgramRun bad = run_program(folder.path("."), {"solve", "small.ply", "-s", "3@-1"});
  EXPECT_EQ(bad.code, 2) << bad.err;
}

TEST_F(ProgramTruth, LabelsNameTheNearestSource) {
  expect_refused({"solve", "small.ply", "-s", "3,400", "--labels"}, "-o FILE.csv or --json");
  const Json solved = json({"solve", "small.ply", "-s", "3,400", "--labels", "-o", "l.csv", "-o",
                            "l.ply", "-o", "l.vtp", "-o", "l.npy", "--json", "-"});
  ASSERT_EQ(solved["regions"].size(), 2U);
  EXPECT_EQ(solved["regions"][0]["source"], 3);
  EXPECT_EQ(solved["regions"][1]["source"], 400);
  const Json& regions = solved["regions"];
  EXPECT_EQ(regions[0]["vertices"].get<int>() + regions[1]["vertices"].get<int>(),
            solved["model"]["vertices"].get<int>());
  const std::string csv = bytes_of(folder.path("l.csv"));
  EXPECT_TRUE(csv.starts_with("vertex,distance,nearest_source\n"));
  EXPECT_NE(csv.find("\n3,0,0\n"), std::string::npos);
  EXPECT_NE(csv.find("\n400,0,1\n"), std::string::npos);
  EXPECT_NE(bytes_of(folder.path("l.ply")).find("property int nearest_source"), std::string::npos);
  EXPECT_NE(bytes_of(folder.path("l.vtp")).find("Name=\"nearest_source\""), std::string::npos);
  EXPECT_NE(bytes_of(folder.path("l.npy")).find(", 2), }"), std::string::npos);
}

TEST_F(ProgramTruth, FilesOfOneSourceKeepTheirShape) {
  run({"solve", "small.ply", "-s", "3", "-o", "d.csv", "-o", "d.ply"});
  EXPECT_TRUE(bytes_of(folder.path("d.csv")).starts_with("vertex,distance\n"));
  EXPECT_EQ(bytes_of(folder.path("d.ply")).find("nearest_source"), std::string::npos);
}

TEST_F(ProgramTruth, CompareHasErrorsAndOtherMethods) {
  const std::string backend = backend_names().front();
  const Json compared = json({"compare", "small.ply", "--queries", "2", "--backends",
                              backend + ",wavefront,exact", "--json", "-"});
  ASSERT_EQ(compared["rows"].size(), 3U);
  const Json& heat = compared["rows"][0];
  EXPECT_EQ(heat["backend"], backend);
  EXPECT_EQ(heat["method"], "heat");
  EXPECT_EQ(heat["error_reference"], "exact");
  EXPECT_GT(heat["mean_error"].get<double>(), compared["rows"][1]["mean_error"].get<double>());
  EXPECT_EQ(compared["rows"][1]["method"], "wavefront");
  EXPECT_EQ(compared["rows"][1]["backend"], "wavefront");
  EXPECT_TRUE(compared["rows"][2]["mean_error"].is_null());
}

TEST_F(ProgramTruth, StudySweepsRulesModesAndBoundaries) {
  const Json study =
      json({"study", "small.ply", "-s", "3", "--factors", "0.1:10:3", "--json", "-"});
  constexpr std::size_t kRules = 2, kFactors = 3, kBoundaries = 3;  // the terrain has a border
  EXPECT_EQ(study["rows"].size(),
            kRules * kFactors * kBoundaries * app::study_constraints().size());
  EXPECT_EQ(study["reference"], "exact");
  double least = 1;
  for (const Json& row : study["rows"]) {
    EXPECT_EQ(row["message"], "");
    least = std::min(least, row["mean_relative"].get<double>());
  }
  EXPECT_NEAR(study["best"]["mean_relative"].get<double>(), least, 1e-6 * least);
}

TEST_F(ProgramTruth, StudyRowsAreWhatSolveGives) {
  const Json study =
      json({"study", "small.ply", "-s", "3", "--factors", "0.1:10:3", "--json", "-"});
  for (const Json& row : study["rows"]) {
    if (row["time_factor"] != 10 || row["boundary"] != "dirichlet") continue;
    if (row["constraint"] != "conserve-energy" || row["time_step"] != "mean-face-area") continue;
    const Json solved =
        json({"solve", "small.ply", "-s", "3", "--check", "-m", "10", "--boundary", "dirichlet",
              "--constraint", "conserve-energy", "--time-step", "mean-face-area", "--json", "-"});
    EXPECT_NEAR(row["mean_relative"].get<double>(), solved["error"]["mean_relative"].get<double>(),
                1e-9);
    EXPECT_NEAR(row["t"].get<double>(), solved["options"]["t"].get<double>(), 1e-12);
    return;
  }
  FAIL() << "no such row";
}

TEST_F(ProgramTruth, StudyDrawsEveryCurve) {
  run({"study", "small.ply", "-s", "3", "--factors", "0.1:10:3", "--svg", "s.svg"});
  const std::string svg = bytes_of(folder.path("s.svg"));
  EXPECT_TRUE(svg.starts_with("<svg"));
  std::size_t curves = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos;
       at = svg.find("<polyline", at + 1)) {
    ++curves;
  }
  EXPECT_EQ(curves, 6 + 6 + app::study_constraints().size());
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST_F(ProgramTruth, StudyKeepsTheEndsOfItsRangeAndNoFactorTwice) {
  const std::vector<double> close = app::study_factors(1.25, 1.26, 5);
  EXPECT_EQ(close.front(), 1.25);
  EXPECT_EQ(close.back(), 1.26);
  EXPECT_EQ(close.size(), 5U);
  EXPECT_TRUE(std::ranges::is_sorted(close, std::less_equal()));
}

TEST_F(ProgramTruth, StudyRefusesOffsets) {
  const ProgramRun failed =
      run_program(folder.path("."), {"study", "small.ply", "-s", "3@0.5", "--svg", "s.svg"});
  EXPECT_EQ(failed.code, 2);
  EXPECT_NE(failed.err.find("offsets"), std::string::npos) << failed.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("s.svg")));
}

TEST_F(ProgramTruth, OptionsThatAnotherMethodDoesNotHaveAreNamed) {
  const ProgramRun warned =
      run({"solve", "small.ply", "-s", "3", "--method", "wavefront", "--backend", "cg", "-m", "7"});
  EXPECT_NE(warned.err.find("--backend"), std::string::npos) << warned.err;
  EXPECT_NE(warned.err.find("--time-factor"), std::string::npos) << warned.err;
  EXPECT_EQ(warned.err.find("--heat"), std::string::npos) << warned.err;
}

TEST_F(ProgramTruth, StudyRefusesAFoldedRange) {
  const ProgramRun failed =
      run_program(folder.path("."), {"study", "small.ply", "--factors", "10:1:3"});
  EXPECT_EQ(failed.code, 2);
  EXPECT_NE(failed.err.find("LEAST:MOST:COUNT"), std::string::npos) << failed.err;
}

}  // namespace
}  // namespace geotherm::test
