// SPDX-License-Identifier: MIT
#include "app/session/compare.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace geotherm::test {
namespace {

using namespace geotherm::app;

const Machine kMachine = {"A <fast> one", 8, "none"};

/// One that worked, and one that failed under a name that each format must escape.
std::vector<CompareRow> rows() {
  CompareRow good;
  good.model = "a\"b<c>,d";
  good.vertices = 10;
  good.faces = 20;
  good.backend = "first";
  good.setup_ms = 1.5;
  good.query_ms_median = good.query_ms_min = good.query_ms_max = 0.25;
  good.max_difference = 0;
  good.mean_difference = 0;
  good.status = "ok";
  CompareRow bad = good;
  bad.backend = "second";
  bad.setup_ms = std::numeric_limits<double>::infinity();
  bad.query_ms_median = bad.query_ms_min = bad.query_ms_max = std::nullopt;
  bad.max_difference = std::nullopt;
  bad.status = "numerical failure";
  bad.note.message = "pivot \"3\" is <= 0, give up";
  return {good, bad};
}

TEST(CompareReports, HaveNullInJsonWhereThereIsNoFigure) {
  const auto json = nlohmann::json::parse(compare_json(kMachine, rows()));
  EXPECT_EQ(json["rows"][0]["model"], "a\"b<c>,d");
  EXPECT_EQ(json["rows"][0]["setup_ms"], 1.5);
  EXPECT_TRUE(json["rows"][1]["setup_ms"].is_null());
  EXPECT_TRUE(json["rows"][1]["query_ms_median"].is_null());
  EXPECT_EQ(json["machine"]["cores"], 8);
}

TEST(CompareReports, SayOfHowManyQueriesTheErrorsAre) {
  auto some = rows();
  EXPECT_EQ(compare_table(kMachine, some).find("errors are of"), std::string::npos);
  some[0].mean_error = some[0].max_error = 0.01;
  some[0].error_queries = 3;
  const std::string said = "errors are of the first 3 queries, of ";
  some[1].error_queries = 3;
  some[1].error_reference = MethodKind::kFastMarching;
  EXPECT_NE(compare_table(kMachine, some)
                .find(said + "a\"b<c>,d against exact, a\"b<c>,d against fast-marching"),
            std::string::npos);
  EXPECT_NE(compare_html(kMachine, some).find(said), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(compare_json(kMachine, some))["rows"][0]["error_queries"], 3);
}

TEST(CompareReports, QuoteTextInCsv) {
  const std::string csv = compare_csv(rows());
  EXPECT_NE(csv.find("\n\"a\"\"b<c>,d\",10,20,\"first\",1.5,0.25,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"numerical failure\",\"pivot \"\"3\"\" is <= 0, give up\","),
            std::string::npos)
      << csv;
}

TEST(CompareReports, HoldNoFormulasInCsv) {
  for (const char first : {'=', '+', '-', '@'}) {
    auto some = rows();
    some[0].model = std::string(1, first) + "cmd|' /C calc'!A0";
    some[1].note.message = std::string(1, first) + "1+1\n=2";
    some[1].mean_difference = -0.5;
    const std::string csv = compare_csv(some);
    EXPECT_NE(csv.find("\n\"'" + some[0].model + "\",10,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",\"'" + std::string(1, first) + "1+1?=2\","), std::string::npos) << csv;
    EXPECT_NE(csv.find(",-0.5,"), std::string::npos) << "numbers stay numbers: " << csv;
  }
}

TEST(CompareReports, EscapeControlCharactersInJson) {
  auto some = rows();
  some[0].model = "a\x7f\xc2\x9b\xc2\xa0\xc3\xa4\xff";
  const std::string json = compare_json(kMachine, some);
  EXPECT_NE(json.find("\"a\\u007f\\u009b\xc2\xa0\xc3\xa4\xef\xbf\xbd\""), std::string::npos)
      << json;
  EXPECT_EQ(nlohmann::json::parse(json)["rows"][0]["model"],
            "a\x7f\xc2\x9b\xc2\xa0\xc3\xa4\xef\xbf\xbd");
}

TEST(CompareReports, ShowFailuresInTheTableWithTheirMessage) {
  const std::string table = compare_table(kMachine, rows());
  EXPECT_NE(table.find("numerical failure "), std::string::npos) << table;
  EXPECT_NE(table.find("second: pivot \"3\" is <= 0, give up\n"), std::string::npos) << table;
}

TEST(CompareReports, EscapeTextOnThePage) {
  const std::string page = compare_html(kMachine, rows());
  EXPECT_NE(page.find("a&quot;b&lt;c&gt;,d"), std::string::npos);
  EXPECT_NE(page.find("A &lt;fast&gt; one"), std::string::npos);
  EXPECT_EQ(page.find("<c>"), std::string::npos);
  EXPECT_EQ(page.find("inf "), std::string::npos);
}

}  // namespace
}  // namespace geotherm::test
