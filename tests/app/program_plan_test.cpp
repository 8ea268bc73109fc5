// SPDX-License-Identifier: MIT
// What `plan` says of work that nobody has done yet.
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

class PlanProgram : public Program {
 protected:
  Json plan(const std::vector<std::string>& words) {
    std::vector<std::string> all = {"plan", "--json", "-"};
    all.insert(all.end(), words.begin(), words.end());
    return json(all)["plan"];
  }
};

TEST_F(PlanProgram, GoesThroughTheMeasuredFigures) {
  const Json small = plan({"--vertices", "140000"}), large = plan({"--vertices", "2.2e6"});
  EXPECT_NEAR(small["setup_seconds"], 0.359, 1e-6);
  EXPECT_NEAR(large["setup_seconds"], 8.44, 1e-6);
  EXPECT_NEAR(large["queries_seconds"], 0.160, 1e-6);
  EXPECT_NEAR(small["memory_mb_of_rank"], 143, 1e-6);
}

TEST_F(PlanProgram, SharesBlocksOfSixteenSources) {
  const Json plan = this->plan({"--vertices", "1e6", "--sources", "100", "--ranks", "3"});
  EXPECT_EQ(plan["rows_of_rank"], 48);
  EXPECT_EQ(plan["idle_ranks"], 0);
  EXPECT_EQ(this->plan({"--vertices", "1e6", "--sources", "20", "--ranks", "8"})["idle_ranks"], 6);
  const double rows = plan["file_bytes"];
  EXPECT_GE(rows, 8e8);
  EXPECT_LE(rows, 8e8 + 1000);
}

TEST_F(PlanProgram, SharesOneMeshOfOneSource) {
  const Json plan = this->plan({"--vertices", "1e9", "--ranks", "256"});
  EXPECT_EQ(plan["vertices_of_rank"], 3906250);
  EXPECT_EQ(plan["blocks"], 256 * 27);
  EXPECT_EQ(plan["rounds"], 173);  // 2 sqrt(6912) + 6, up
  const Json twice = this->plan({"--vertices", "1e9", "--ranks", "512"});
  EXPECT_NEAR(plan["poisson_seconds"], 2.0 * double{twice["poisson_seconds"]}, 1e-3);
  EXPECT_NEAR(plan["setup_seconds"], 2.0 * double{twice["setup_seconds"]}, 1e-3);
  EXPECT_NEAR(plan["queries_seconds"],
              double{plan["heat_seconds"]} + double{plan["poisson_seconds"]}, 1e-9);
  expect_refused({"plan", "--vertices", "1e10", "--ranks", "9"}, "2,147,483,647");
}

TEST_F(PlanProgram, LetsWavesPassSharesOneAfterTheOther) {
  const Json few = plan({"--vertices", "4e6", "--ranks", "4"});
  const Json many = plan({"--vertices", "4e6", "--ranks", "16"});
  EXPECT_NEAR(few["waves_seconds"], 2.0 * double{many["waves_seconds"]}, 1e-9);
  EXPECT_EQ(few["waves_exchanges"], many["waves_exchanges"]);
  const Json longer = plan({"--vertices", "16e6", "--ranks", "16"});
  EXPECT_NEAR(longer["waves_exchanges"], 2.0 * double{few["waves_exchanges"]}, 1.0);
}

TEST_F(PlanProgram, CountsTheRoundsThatRanksWaitFor) {
  const Json few = plan({"--vertices", "300000", "--ranks", "2"});
  const Json many = plan({"--vertices", "1.5e8", "--ranks", "1000"});
  ASSERT_EQ(few["vertices_of_rank"], many["vertices_of_rank"]);
  EXPECT_EQ(few["poisson_seconds"], many["poisson_seconds"]);
  const double more = double{many["rounds"]} / double{few["rounds"]};
  EXPECT_NEAR(many["heat_seconds"], more * double{few["heat_seconds"]}, 1e-9);
}

TEST_F(PlanProgram, RefusesWhatNoProcessHoldsAndWhatIsNoCount) {
  expect_refused({"plan", "--vertices", "1e9"}, "715,827,882");
  expect_refused({"plan", "--vertices", "1e9", "--ranks", "256", "--sources", "3"},
                 "one row, from any number of sources");
  expect_refused({"plan", "--vertices", "many"}, "--vertices");
  expect_refused({"plan", "--vertices", "1e6", "--ranks", "0"}, "--ranks");
  expect_refused({"plan", "--vertices", "1e6", "--sources", "1.5"}, "--sources");
}

}  // namespace
}  // namespace geotherm::test
