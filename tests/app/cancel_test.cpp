// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "app/cli/commands.h"
#include "tests/app/fake_drawing.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using namespace geotherm::app;

TEST(CancelledSolve, BetweenTwoFilesIsNoSuccessAndLeavesNone) {
  const TemporaryDirectory folder;
  SolveArguments arguments;
  arguments.model = "bunny";
  arguments.sources.sources = {"1"};
  arguments.outputs = {folder.path("a.csv"), folder.path("b.csv")};
  bool first_was_there = false;
  const auto result = run_solve(arguments, FakeDrawing(), [&](std::string_view stage, double) {
    if (stage.find("b.csv") == std::string_view::npos) return true;
    first_was_there = folder.names() == std::vector<std::string>{"a.csv"};
    return false;
  });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_TRUE(first_was_there);
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

}  // namespace
}  // namespace geotherm::test
