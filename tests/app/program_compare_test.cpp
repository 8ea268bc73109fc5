// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "geotherm/backend.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

using ProgramCompare = Program;

TEST_F(ProgramCompare, HasARowForEachBackendAndModel) {
  ASSERT_EQ(run({"generate", "cube", "--faces", "600", "-o", "cube.ply"}).code, 0);
  const Json compared = json({"compare", "bunny", "cube.ply", "--queries", "2", "--json", "-"});
  expect_keys(compared["machine"], keys({"cpu", "cores", "blas"}), "machine.");
  const std::size_t backends = backend_names().size();
  ASSERT_EQ(compared["rows"].size(), 2 * backends);
  for (std::size_t i = 0; i < compared["rows"].size(); ++i) {
    const Json& row = compared["rows"][i];
    expect_keys(row,
                keys({"model", "vertices", "faces", "backend", "setup_ms", "query_ms_median",
                      "batch_query_ms", "factor_mb", "peak_rss_mb", "max_difference",
                      "mean_difference", "status", "message"}),
                "row.");
    EXPECT_EQ(row["model"], i < backends ? "bunny" : "cube");
    EXPECT_EQ(row["backend"], backend_names()[i % backends]);
    EXPECT_EQ(row["status"], "ok") << row;
    constexpr double kIterative = 1e-6;  // what an iterative backend promises
    EXPECT_LE(row["max_difference"].get<double>(), kIterative);
    EXPECT_LE(row["mean_difference"], row["max_difference"]);
  }
}

TEST_F(ProgramCompare, WritesTableCsvAndPage) {
  const ProgramRun result = run({"compare", "bunny", "--queries", "1", "-s", "random:3", "--csv",
                                 "t.csv", "--html", "t.html", "--json", "t.json"});
  EXPECT_NE(result.out.find("pre-factorisation"), std::string::npos);
  const std::string csv = bytes_of(folder.path("t.csv"));
  EXPECT_TRUE(csv.starts_with("model,vertices,faces,backend,setup_ms,query_ms_median"));
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + backend_names().size());
  const std::string page = bytes_of(folder.path("t.html"));
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page must need nothing else";
  EXPECT_TRUE(Json::accept(bytes_of(folder.path("t.json"))));
}

TEST_F(ProgramCompare, MeasuresFromTheReference) {
  const std::string last = backend_names().back();
  const Json compared =
      json({"compare", "bunny", "--queries", "1", "--reference", last, "--json", "-"});
  EXPECT_EQ(compared["rows"].back()["backend"], last);
  EXPECT_EQ(compared["rows"].back()["max_difference"], 0.0);
}

TEST_F(ProgramCompare, KeepsTheAnswersOfTheFirstQueriesOnly) {
  const auto peak = [this](const char* queries) {
    const Json compared = json({"compare", "bunny", "--queries", queries, "--backends",
                                backend_names().front(), "--threads", "1", "--json", "-"});
    return compared["rows"][0]["peak_rss_mb"].get<double>();
  };
  // 1990 more answers of about 2000 doubles are 30 MB; source sets and times of that many, 1 MB.
  constexpr double kMax = 10;
  EXPECT_LT(peak("2000") - peak("10"), kMax);
}

constexpr const char* kFlat = "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n";

TEST_F(ProgramCompare, FailsInOneLineWhereEverySolverFailsAndKeepsTheRows) {
  folder.write("flat.obj", kFlat);
  const ProgramRun failed = run_program(
      folder.path("."), {"compare", "bunny", "flat.obj", "--queries", "1", "--json", "t.json"});
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(failed.err.starts_with("geotherm: error: flat: all ")) << failed.err;
  for (const char* part : {" solvers failed; native: the mesh has no face with area (1 face, ",
                           "; check how it was exported"}) {
    EXPECT_NE(failed.err.find(part), std::string::npos) << failed.err;
  }
  EXPECT_EQ(std::count(failed.err.begin(), failed.err.end(), '\n'), 1) << failed.err;
  EXPECT_NE(failed.out.find("pre-factorisation"), std::string::npos);
  const Json compared = Json::parse(bytes_of(folder.path("t.json")));
  const std::size_t backends = backend_names().size();
  ASSERT_EQ(compared["rows"].size(), 2 * backends);
  for (std::size_t i = 0; i < 2 * backends; ++i) {
    const Json& row = compared["rows"][i];
    EXPECT_EQ(row["status"] == "ok", i < backends) << row;
    EXPECT_EQ(row["message"] == "", i < backends) << row;
    EXPECT_EQ(row["setup_ms"].is_null(), i >= backends) << row;
  }
}

TEST_F(ProgramCompare, NamesABackendThatFailsOnce) {
  const std::string name = backend_names().front();
  const ProgramRun failed =
      run_program(folder.path("."), {"compare", "bunny", "--queries", "1", "--backends", name,
                                     "--memory-limit", "0.2", "--json", "t.json"});
  EXPECT_EQ(failed.code, 1);
  const std::string needs = "needs about ";
  EXPECT_TRUE(failed.err.starts_with("geotherm: error: bunny: " + name + " failed: " + needs))
      << failed.err;
  EXPECT_NE(failed.out.find("\nbunny, " + name + ": " + needs), std::string::npos) << failed.out;
  const Json row = Json::parse(bytes_of(folder.path("t.json")))["rows"][0];
  EXPECT_TRUE(row["message"].get<std::string>().starts_with(needs)) << row;
}

}  // namespace
}  // namespace geotherm::test
