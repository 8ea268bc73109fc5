// SPDX-License-Identifier: MIT
#include "bench/bench_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace geotherm::test {
namespace {

using bench::all_cases;
using bench::backends_for;
using bench::Case;
using bench::case_name;
using bench::SolvePlan;

/// "MESH-SIZE/BACKEND" of all rows of a plan.
std::set<std::string> rows(bool quick, const std::string& only) {
  const SolvePlan plan{.quick = quick, .backends = {"one", "two"}, .only = std::regex(only)};
  std::set<std::string> out;
  for (const Case& c : all_cases()) {
    for (const std::string& name : backends_for(c, plan)) out.insert(case_name(c) + "/" + name);
  }
  return out;
}

TEST(BenchCases, HaveARegularAndAnIrregularMeshOfEachSize) {
  for (const Index faces : {30'000, 100'000, 280'000, 1'100'000, 4'400'000}) {
    for (const bool regular : {true, false}) {
      EXPECT_TRUE(std::ranges::any_of(
          all_cases(), [&](const Case& c) { return c.faces == faces && c.regular == regular; }))
          << faces << (regular ? " regular" : " irregular");
    }
  }
}

TEST(BenchCases, GrowSoThatEachCanBeEstimatedFromThoseBefore) {
  EXPECT_TRUE(std::ranges::is_sorted(all_cases(), {}, &Case::faces));
}

TEST(BenchCases, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Case& c : all_cases()) EXPECT_TRUE(names.insert(case_name(c)).second) << case_name(c);
}

TEST(BenchCases, OfAQuickRunAreSomeOfTheOthers) {
  const std::set<std::string> quick = rows(true, ""), full = rows(false, "");
  EXPECT_LT(quick.size(), full.size());
  EXPECT_GT(quick.size(), 0u);
  EXPECT_TRUE(std::ranges::includes(full, quick));
}

TEST(BenchCases, OfAQuickRunAreThoseThatAreNamed) {
  const SolvePlan plan{
      .quick = true, .backends = {"one"}, .only = std::regex("4400k"), .chosen = true};
  int found = 0;
  for (const Case& c : all_cases()) found += static_cast<int>(backends_for(c, plan).size());
  EXPECT_EQ(found, 2);
}

TEST(BenchCases, AreThoseInWhichTheExpressionIsFound) {
  EXPECT_EQ(rows(false, "^torus-1100k/two$"), std::set<std::string>{"torus-1100k/two"});
  EXPECT_TRUE(rows(false, "no such row").empty());
  for (const std::string& row : rows(false, "grid.*/one")) {
    EXPECT_TRUE(row.starts_with("grid-") && row.ends_with("/one")) << row;
  }
}

/// Vertices by their number of neighbours.
std::map<int, int> degrees(const char* mesh) {
  const auto made = bench::make_mesh(mesh, 5000);
  std::vector<int> degree(static_cast<std::size_t>(made->vertex_count()), 0);
  for (const Face& face : made->faces()) {
    for (const Index v : face) ++degree[static_cast<std::size_t>(v)];
  }
  std::map<int, int> out;
  for (const int d : degree) ++out[d];
  return out;
}

TEST(BenchMeshes, RegularOnesHaveSixNeighboursAndIrregularOnesHaveNot) {
  EXPECT_EQ(degrees("grid").size(), 1u);
  EXPECT_EQ(degrees("grid").begin()->first, 6);
  EXPECT_GE(degrees("torus").size(), 4u);
}

}  // namespace
}  // namespace geotherm::test
