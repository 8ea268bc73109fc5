// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "app/session/model.h"
#include "geotherm/backend.h"
#include "geotherm/io.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

/// One rounding in each of two factors.
constexpr double kLastDigits = 1e-15;

TEST_F(Program, SolveShowsATable) {
  const ProgramRun result = run({"solve", "bunny", "-s", "17"});
  for (const char* part : {"bunny", "backend", "set-up", "query", "MB factors", "mean", "residuals",
                           backend_names().front().c_str()}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << " is not in\n" << result.out;
  }
  EXPECT_EQ(result.err, "");
}

TEST_F(Program, SolveJsonHasTheKeysOfTheContract) {
  const Json solved = json({"solve", "bunny", "-s", "3,99", "--json", "-"});
  const Json expected = {
      {"model", keys({"name", "vertices", "faces", "components", "boundary_edges",
                      "nonmanifold_edges", "degenerate_faces", "mean_edge_length", "area"})},
      {"options", keys({"method", "backend", "time_step", "time_factor", "t", "constraint", "heat",
                        "boundary", "laplacian", "threads"})},
      {"sources", nullptr},
      {"distance", keys({"min", "max", "mean", "unreached"})},
      {"timing_ms", keys({"load", "operators", "analyze", "factorize", "setup", "diffuse",
                          "gradient", "poisson", "query"})},
      {"memory_mb", keys({"factor", "peak_rss"})},
      {"quality",
       keys({"heat_residual", "poisson_residual", "max_source_distance", "eikonal_error_mean",
             "zero_gradient_faces", "iterations_heat", "iterations_poisson", "below_straight_line",
             "most_below_straight_line", "steep_edges", "steepest_edge"})},
      {"warnings", nullptr}};
  expect_keys(solved, expected, "");
  EXPECT_EQ(solved["model"]["name"], "bunny");
  EXPECT_EQ(solved["sources"], Json({3, 99}));
  EXPECT_EQ(solved["distance"]["min"], 0.0);
  EXPECT_EQ(solved["options"]["backend"], backend_names().front());
  EXPECT_GE(solved["options"]["threads"], 1);
  EXPECT_GT(solved["memory_mb"]["peak_rss"], 0.0);
}

TEST_F(Program, SolveJsonHoldsTheTimeStepToRoundOff) {
  const Json edge = json({"solve", "bunny", "-s", "1", "-m", "3", "--json", "-"});
  const double h = edge["model"]["mean_edge_length"];
  EXPECT_NEAR(edge["options"]["t"].get<double>(), 3 * h * h, 3 * h * h * kLastDigits);
  EXPECT_EQ(edge["options"]["time_factor"], 3.0);
  const Json area =
      json({"solve", "bunny", "-s", "1", "--time-step", "mean-face-area", "--json", "-"});
  const double mean = area["model"]["area"].get<double>() / area["model"]["faces"].get<double>();
  constexpr double kSumOfFaces = 1e-12;
  EXPECT_NEAR(area["options"]["t"].get<double>(), mean, mean * kSumOfFaces);
  const Json given = json(
      {"solve", "bunny", "-s", "1", "--time-step", "absolute:0.01", "--no-check", "--json", "-"});
  EXPECT_EQ(given["options"]["t"], 0.01);
  EXPECT_TRUE(given["options"]["time_factor"].is_null());
  EXPECT_EQ(given["warnings"], Json::array());
}

TEST_F(Program, SolveJsonHoldsTheTimeOfOneComponentOnceAndTheExtremesOfSeveral) {
  const Json one = json({"solve", "bunny", "-s", "1", "--json", "-"})["options"];
  EXPECT_EQ(one["t_of_components"], Json::array({one["t"]}));
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 8 0 0\nv 5 3 0\nf 1 2 3\nf 4 5 6\n");
  const Json two = json({"solve", "two.obj", "-s", "0", "--json", "-"})["options"];
  ASSERT_EQ(two["t_of_components"].size(), 2U);
  const double least = two["t_of_components"][0], most = two["t_of_components"][1];
  EXPECT_NEAR(most, 9 * least, most * kLastDigits);  // edges are three times as long
}

TEST_F(Program, SaysThatATimeFactorBesideAnAbsoluteTimeIsNotUsed) {
  const std::vector<std::string> options = {"--time-step", "absolute:0.01", "-m", "3"};
  const auto with = [&options](std::vector<std::string> words) {
    words.insert(words.end(), options.begin(), options.end());
    return words;
  };
  const ProgramRun solved = run(with({"solve", "bunny", "-s", "1", "--no-check", "--json", "-"}));
  EXPECT_NE(solved.err.find("geotherm: warning: --time-factor 3 is not used"), std::string::npos)
      << solved.err;
  EXPECT_EQ(Json::parse(solved.out)["warnings"].size(), 1U);
  const ProgramRun compared = run(with({"compare", "bunny", "--queries", "1"}));
  EXPECT_NE(compared.err.find("--time-factor 3 is not used"), std::string::npos) << compared.err;
}

TEST_F(Program, SolveWritesEveryFormatAndNothingElse) {
  run({"solve", "bunny", "-s", "5", "-o", "d.csv", "-o", "d.npy", "-o", "d.ply", "-o", "d.vtp",
       "--json", "d.json"});
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"d.csv", "d.json", "d.npy", "d.ply", "d.vtp"}));
  EXPECT_TRUE(read_mesh(folder.path("d.ply")));
  EXPECT_TRUE(Json::accept(bytes_of(folder.path("d.json"))));
}

TEST_F(Program, SolveWritesCsvAndNothingElseToStandardOutput) {
  const ProgramRun result = run({"solve", "bunny", "-s", "5", "-o", "-", "-o", "same.csv"});
  EXPECT_EQ(result.out, bytes_of(folder.path("same.csv")));
  EXPECT_TRUE(result.out.starts_with("vertex,distance\n0,"));
  EXPECT_NE(result.out.find("\n5,0\n"), std::string::npos);
}

TEST_F(Program, SolveReplacesAFileThatIsThere) {
  folder.write("d.csv", "old");
  run({"solve", "bunny", "-s", "5", "-o", "d.csv"});
  EXPECT_TRUE(bytes_of(folder.path("d.csv")).starts_with("vertex,distance\n"));
}

TEST_F(Program, SolveTakesSourcesOfAllKindsAsOneSet) {
  folder.write("more.txt", "# more\n7\nface:4:0.5:0.25:0.25  # inside\n\n0.1 2 0\n");
  const Json solved = json({"solve", "-s", "3", "-s", "random:2:9", "bunny", "--source-file",
                            "more.txt", "-s", "face:9:0:1:0", "--json", "-"});
  std::size_t inside = 0;
  for (const Json& source : solved["sources"]) inside += source.is_object();
  EXPECT_GE(inside, 1U);
  EXPECT_EQ(solved["sources"].size(), 7U);
}

TEST_F(Program, SolveTakesTheBoundaryAndACurveAsEdges) {
  ASSERT_EQ(run({"generate", "terrain", "--faces", "1000", "-o", "t.off"}).code, 0);
  const Json border = json({"solve", "t.off", "-s", "boundary", "--json", "-"});
  EXPECT_EQ(border["source_edges"].size(), border["model"]["boundary_edges"]);
  folder.write("curve.txt", "0\n200\n");
  const ProgramRun curve =
      run({"solve", "t.off", "--source-file", "curve.txt", "--curve", "-o", "-"});
  EXPECT_NE(curve.err.find("geotherm: warning: curve.txt"), std::string::npos) << curve.err;
  EXPECT_NE(curve.out.find("\n200,0\n"), std::string::npos);
}

TEST_F(Program, SolveSaysWhatIsUnreached) {
  folder.write("two.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 9 9 9\nf 1 2 3\nf 4 5 6\n");
  const ProgramRun result = run({"solve", "two.obj", "-s", "0", "--json", "-"});
  const Json solved = Json::parse(result.out);
  EXPECT_EQ(solved["distance"]["unreached"], 4);
  EXPECT_GE(solved["warnings"].size(), 2U);
  EXPECT_NE(result.err.find("geotherm: warning: 1 vertex belongs to no face"), std::string::npos);
  EXPECT_NE(result.err.find("geotherm: warning: 3 vertices lie in components"), std::string::npos);
  EXPECT_NE(run({"solve", "two.obj", "-s", "0", "-o", "-"}).out.find("\n6,inf\n"),
            std::string::npos);
}

/// The two faces touch along an edge whose ends stand twice in the file.
TEST_F(Program, SolveKnowsWhereWeldingReachesMore) {
  const std::string first = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", faces = "f 1 2 3\nf 4 5 6\n";
  folder.write("soup.obj", first + "v 1 0 0\nv 1 1 0\nv 0 1 0\n" + faces);
  folder.write("apart.obj", first + "v 5 0 0\nv 5 1 0\nv 4 1 0\n" + faces);
  const std::string cure =
      "--weld 0 joins vertices that lie on each other, which leaves 1 component";
  const std::string soup = run({"solve", "soup.obj", "-s", "0"}).err;
  EXPECT_NE(soup.find(cure), std::string::npos) << soup;
  const std::string apart = run({"solve", "apart.obj", "-s", "0"}).err;
  EXPECT_NE(apart.find("3 vertices lie in components"), std::string::npos) << apart;
  EXPECT_EQ(apart.find("--weld"), std::string::npos) << apart;
  EXPECT_EQ(run({"solve", "soup.obj", "-s", "0", "--weld", "0"}).err.find("components"),
            std::string::npos);
}

class ProgramBackends : public Program, public testing::WithParamInterface<std::string> {};

TEST_P(ProgramBackends, SolveWithEachName) {
  const Json solved =
      json({"solve", "bunny", "-s", "1", "--backend", GetParam(), "--threads", "1", "--json", "-"});
  EXPECT_EQ(solved["options"]["backend"], GetParam());
  EXPECT_EQ(solved["options"]["threads"], 1);
  EXPECT_GT(solved["distance"]["max"], 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, ProgramBackends, testing::ValuesIn(backend_names()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_F(Program, SolvePassesOptionsOn) {
  const Json solved = json({"solve", "bunny", "-s", "1,900", "--constraint", "penalty:5", "--heat",
                            "hold", "--boundary", "average", "--laplacian", "intrinsic-delaunay",
                            "--variant", "classic", "--precision", "refined", "--json", "-"});
  EXPECT_EQ(solved["options"]["constraint"], "penalty:5");
  EXPECT_EQ(solved["options"]["heat"], "hold");
  EXPECT_EQ(solved["options"]["boundary"], "average");
  EXPECT_EQ(solved["options"]["laplacian"], "intrinsic-delaunay");
  EXPECT_EQ(solved["options"]["variant"], "classic");
  EXPECT_EQ(solved["options"]["precision"], "refined");
}

TEST_F(Program, InfoTellsWhatAMeshIs) {
  const ProgramRun table = run({"info", "bunny"});
  EXPECT_NE(table.out.find("Euler characteristic"), std::string::npos);
  EXPECT_EQ(table.err, "");
  const Json info = json({"info", "bunny", "--json", "-"});
  expect_keys(info["model"],
              keys({"name", "vertices", "faces", "components", "boundary_edges",
                    "nonmanifold_edges", "degenerate_faces", "mean_edge_length", "area"}),
              "model.");
  EXPECT_EQ(info["model"]["components"], 1);
  EXPECT_EQ(info["warnings"], Json::array());
}

TEST_F(Program, InfoWarnsInWords) {
  folder.write("odd.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 9 9 9\nf 1 2 4 3\nf 1 1 2\nf 1 2 4\n");
  const ProgramRun result = run({"info", "odd.obj"});
  for (const char* part : {"1 polygon was triangulated", "1 vertex belongs to no face",
                           "1 face repeats a corner", "1 duplicate face"}) {
    EXPECT_NE(result.err.find(std::string("geotherm: warning: ") + part), std::string::npos)
        << result.err;
  }
}

TEST_F(Program, InfoCountsOneThingAsOne) {
  folder.write("one.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n");
  EXPECT_EQ(run({"info", "one.off"}).err,
            "geotherm: warning: 1 face with fewer than 3 corners was left out\n");
}

TEST_F(Program, InfoSaysThatAnStlWasWelded) {
  run({"generate", "bunny", "-o", "b.stl"});
  EXPECT_NE(run({"info", "b.stl"}).err.find("welded"), std::string::npos);
}

TEST_F(Program, GenerateWritesEveryFormat) {
  for (const char* file : {"b.obj", "b.ply", "b.off", "b.stl"}) {
    run({"generate", "bunny", "--faces", "1000", "-o", file});
    EXPECT_TRUE(read_mesh(folder.path(file))) << file;
  }
  const ProgramRun text = run({"generate", "bunny", "--faces", "1000", "-o", "-"});
  EXPECT_EQ(text.out, bytes_of(folder.path("b.obj")));
}

TEST_F(Program, ListsNameOneThingALine) {
  const std::string backends = run({"backends"}).out;
  EXPECT_TRUE(backends.starts_with(backend_names().front()));
  EXPECT_EQ(static_cast<std::size_t>(std::count(backends.begin(), backends.end(), '\n')),
            backend_names().size());
  const std::string models = run({"models"}).out;
  EXPECT_EQ(static_cast<std::size_t>(std::count(models.begin(), models.end(), '\n')),
            app::bundled_models().size());
  for (const app::BundledModel& model : app::bundled_models()) {
    EXPECT_NE(models.find(std::string(model.name) + " "), std::string::npos);
  }
}

TEST_F(Program, ListsAreTheSameAsJson) {
  const Json backends = json({"backends", "--json", "-"})["backends"];
  ASSERT_EQ(backends.size(), backend_names().size());
  for (std::size_t i = 0; i < backends.size(); ++i) {
    EXPECT_EQ(backends[i]["name"], backend_names()[i]);
    EXPECT_EQ(backends[i]["default"], i == 0);
    EXPECT_NE(backends[i]["description"], "");
  }
  run({"models", "--json", "m.json"});
  const Json models = Json::parse(bytes_of(folder.path("m.json")))["models"];
  ASSERT_EQ(models.size(), app::bundled_models().size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    EXPECT_EQ(models[i]["name"], app::bundled_models()[i].name);
    EXPECT_EQ(models[i]["faces"], app::bundled_models()[i].faces);
  }
}

TEST_F(Program, HelpShowsAnExample) {
  EXPECT_TRUE(run({"--version"}).out.starts_with("geotherm "));
  EXPECT_NE(run({"--help"}).out.find("geotherm solve bunny -s 17"), std::string::npos);
  for (const char* command : {"solve", "info", "compare", "generate", "backends", "models"}) {
    EXPECT_NE(run({command, "--help"}).out.find(std::string("  geotherm ") + command),
              std::string::npos)
        << command;
  }
}

}  // namespace
}  // namespace geotherm::test
