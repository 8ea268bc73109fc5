// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "geotherm/backend.h"
#include "tests/app/program_fixture.h"

namespace geotherm::test {
namespace {

TEST_F(Program, SolveSaysWhichBackendTookOverAndWhy) {
  const std::string asked = backend_names().front();
  const Json solved = json({"solve", "bunny", "-s", "3", "--memory-limit", "0.2", "--json", "-"});
  const Json& options = solved["options"];
  EXPECT_EQ(options["backend"], "cg");
  EXPECT_EQ(options["backend_asked"], asked);
  ASSERT_EQ(options["fallbacks"].size(), backend_names().size() - 1);
  EXPECT_EQ(options["fallbacks"][0]["backend"], asked);
  const std::string reason = options["fallbacks"][0]["reason"];
  EXPECT_NE(reason.find("the limit is 0.2 MB"), std::string::npos) << reason;
  EXPECT_EQ(solved["memory_mb"]["factor"], 0.0);
  EXPECT_EQ(solved["memory_mb"]["factor_forecast"], 0.0);
  ASSERT_EQ(solved["warnings"].size(), 1U);
  const std::string warning = solved["warnings"][0];
  EXPECT_EQ(warning.find(asked + " failed: " + reason), 0U) << warning;
  EXPECT_NE(warning.find("; cg took over"), std::string::npos) << warning;
}

TEST_F(Program, SolveForeseesTheMemoryOfItsFactors) {
  constexpr double kForecast = 0.1;
  const Json solved = json({"solve", "bunny", "-s", "3", "--memory-limit", "1G", "--json", "-"});
  const double factor = solved["memory_mb"]["factor"];
  EXPECT_GT(factor, 0);
  EXPECT_NEAR(solved["memory_mb"]["factor_forecast"].get<double>(), factor, kForecast * factor);
  EXPECT_EQ(solved["options"]["backend_asked"], solved["options"]["backend"]);
  EXPECT_EQ(solved["options"]["fallbacks"], Json::array());
}

TEST_F(Program, CompareReplacesNoBackend) {
  const Json compared = json({"compare", "bunny", "--queries", "1", "--backends", "eigen-ldlt,cg",
                              "--memory-limit", "0.2", "--json", "-"});
  EXPECT_EQ(compared["rows"][0]["status"], "out of memory");
  EXPECT_NE(compared["rows"][0]["message"].get<std::string>().find("the limit is 0.2 MB"),
            std::string::npos);
  EXPECT_EQ(compared["rows"][1]["status"], "ok");
}

}  // namespace
}  // namespace geotherm::test
