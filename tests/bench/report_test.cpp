// SPDX-License-Identifier: MIT
#include "bench/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/bench/bench_fixture.h"

namespace geotherm::test {
namespace {

using Json = nlohmann::json;

TEST(BenchJson, HasTheKeysThatScriptsReadAndNoBaselineRow) {
  const Json json = Json::parse(bench::to_json(sample_run()));
  ASSERT_EQ(json["solve"].size(), 16u);
  for (const Json& row : json["solve"]) {
    EXPECT_NE(row["backend"], "baseline");
    for (const char* key :
         {"mesh", "faces", "vertices", "regular", "backend", "setup_ms", "query_ms",
          "batch16_ms_per_source", "factor_mb", "setup_ratio", "query_ratio", "batch16_ratio",
          "memory_ratio", "factor_gflops", "factor_gflops_share", "solve_gbs", "solve_gbs_share"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
  }
  for (const Json& row : json["growth"]) {
    for (const char* key : {"backend", "setup_exponent", "query_exponent", "regular"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
  }
  EXPECT_EQ(json["machine"]["limits"]["fma_gflops"], Json::parse("[50.0, 100.0]"));
  for (const char* absent : {"load", "moving", "render", "explore"})
    EXPECT_FALSE(json.contains(absent));
}

TEST(BenchMoving, SolvesTheSameFramesBothWaysAndIsReported) {
  constexpr int kFrames = 2;
  const auto mesh = bench::make_mesh("gargoyle", 2000);
  ASSERT_TRUE(mesh);
  bench::BenchRun run = sample_run();
  for (const MethodKind method : {MethodKind::kHeat, MethodKind::kWavefront}) {
    run.moving.push_back(bench::measure_moving(method, "gargoyle", *mesh, kFrames, 1));
    const bench::MovingRow& row = run.moving.back();
    EXPECT_EQ(row.failure, "");
    EXPECT_GT(row.fresh_ms, 0);
    EXPECT_GT(row.moved_ms, row.query_ms);
    EXPECT_LT(row.difference, 1e-9);
  }
  const bench::MovingRow& row = run.moving.front();
  const Json json = Json::parse(bench::to_json(run))["moving"];
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[1]["method"], "wavefront");
  EXPECT_EQ(json[0]["frames"], kFrames);
  EXPECT_DOUBLE_EQ(json[0]["ratio"], row.fresh_ms / row.moved_ms);
  EXPECT_NE(bench::to_markdown(run).find("A frame of gargoyle waving"), std::string::npos);
}

TEST(BenchJson, SaysWhyARowWasNotRunAndHasNullsThere) {
  const Json json = Json::parse(bench::to_json(sample_run()));
  const auto row =
      std::ranges::find_if(json["solve"], [](const Json& r) { return r["status"] == "not run"; });
  ASSERT_NE(row, json["solve"].end());
  EXPECT_EQ((*row)["backend"], "slow");
  EXPECT_NE(std::string((*row)["message"]).find("1000 s"), std::string::npos);
  EXPECT_TRUE((*row)["setup_ms"].is_null());
  EXPECT_TRUE((*row)["setup_ratio"].is_null());
}

TEST(Ratios, AreTheBaselinesTimesOverOursAndOurMemoryOfIts) {
  const bench::BenchRun run = sample_run();
  const bench::SolveGroup& group = run.groups.front();
  const bench::Ratios ratios = bench::ratios_of(group.figures[0], group.baseline());
  EXPECT_DOUBLE_EQ(ratios.setup, 4);
  EXPECT_DOUBLE_EQ(ratios.memory, 0.5);
  EXPECT_TRUE(std::isnan(bench::ratios_of(group.figures[0], nullptr).setup));
}

TEST(Shares, AreOfWhatAsManyThreadsCanDo) {
  const bench::BenchRun run = sample_run();
  const bench::Rates rates{.factor_gflops = 25, .solve_gbs = 15, .factor_bytes = 1e9};
  EXPECT_DOUBLE_EQ(bench::shares_of(rates, run.limits, 2).factor, 0.25);
  EXPECT_DOUBLE_EQ(bench::shares_of(rates, run.limits, 1).factor, 0.5);
  EXPECT_DOUBLE_EQ(bench::shares_of(rates, run.limits, 2).solve, 0.5);
  EXPECT_TRUE(std::isnan(bench::shares_of(rates, {}, 2).factor));
  const bench::Shares cached =
      bench::shares_of({.solve_gbs = 100, .factor_bytes = 4e6}, run.limits, 1);
  EXPECT_DOUBLE_EQ(cached.solve, 1);   // of the cache that holds it
  EXPECT_DOUBLE_EQ(cached.memory, 5);  // more than memory gives
}

TEST(BenchMarkdown, HasAsManyCellsInEachRowOfATable) {
  std::istringstream text(bench::to_markdown(sample_run()));
  std::ptrdiff_t cells = 0;
  int rows = 0;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with("|")) {
      cells = 0;
      continue;
    }
    ++rows;
    const auto here = std::ranges::count(line, '|');
    if (cells == 0) cells = here;
    EXPECT_EQ(here, cells) << line;
  }
  EXPECT_GT(rows, 30);
}

TEST(BenchMarkdown, SaysWhyAFigureIsMissing) {
  const std::string text = bench::to_markdown(sample_run());
  EXPECT_NE(text.find("| not run |"), std::string::npos);
  EXPECT_NE(text.find("- torus, 1.1M, `slow`: would take about 1000 s"), std::string::npos) << text;
}

TEST(BenchText, NamesWhatWasNotRun) {
  const bench::BenchRun run = sample_run();
  const std::string text = bench::solve_text(run.groups.back(), run.limits, 2);
  EXPECT_NE(text.find("not run: would take about 1000 s"), std::string::npos) << text;
}

}  // namespace
}  // namespace geotherm::test
