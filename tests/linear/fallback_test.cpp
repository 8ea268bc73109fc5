// SPDX-License-Identifier: MIT
#include "solver/linear/fallback.h"

#include <gtest/gtest.h>

#include "solver/linear/backend.h"

namespace geotherm::test {
namespace {

const Error kPivot = {ErrorCode::kNumericalFailure, "first: pivot 3 of 8; try another"};

TEST(Fallback, TellsTheReasonWithoutNameAndCure) {
  EXPECT_EQ(failure_of("first", kPivot).reason, "pivot 3 of 8");
  EXPECT_EQ(failure_of("cg", {ErrorCode::kBudgetEnded, "cg ran long"}).reason, "ran long");
  EXPECT_EQ(failure_of("cg", {ErrorCode::kBudgetEnded, "no cure"}).reason, "no cure");
}

TEST(Fallback, NamesABackendOnce) {
  EXPECT_EQ(without_backend("cg: it ended; less", "cg"), "it ended; less");
  EXPECT_EQ(without_backend("cg needs 2 MB; less", "cg"), "needs 2 MB; less");
  EXPECT_EQ(without_backend("cgx needs 2 MB", "cg"), "cgx needs 2 MB");
  EXPECT_EQ(without_backend("needs 2 MB", ""), "needs 2 MB");
}

TEST(Fallback, GoesThroughTheOthersInTheirOrder) {
  const std::vector<std::string> names = backend_names();
  std::vector<Fallback> failed = {failure_of(names.back(), kPivot)};
  std::vector<std::string> tried;
  for (;;) {
    const std::string next = next_backend(failed, Successor::kAny);
    if (next.empty()) break;
    tried.push_back(next);
    failed.push_back(failure_of(next, kPivot));
  }
  EXPECT_EQ(tried, std::vector<std::string>(names.begin(), names.end() - 1));
}

TEST(Fallback, AsksForAFactorOrForNone) {
  const std::vector<Fallback> failed = {failure_of(backend_names().front(), kPivot)};
  EXPECT_EQ(next_backend(failed, Successor::kFactorless), "cg");
  EXPECT_FALSE((*find_backend(next_backend({}, Successor::kFactored)))->iterative());
  EXPECT_EQ(next_backend(failed, Successor::kNone), "");
}

TEST(Fallback, SaysWhoFailedWhyAndWhoTookOver) {
  const std::vector<Fallback> failed = {
      failure_of("first", kPivot), failure_of("second", {ErrorCode::kOutOfMemory, "2 GB; less"})};
  EXPECT_EQ(takeover_text(failed, "third"),
            "first failed: pivot 3 of 8; second failed: 2 GB; third took over");
  EXPECT_EQ(joint_error(failed).message, "first: pivot 3 of 8, second: 2 GB; less");
  EXPECT_EQ(joint_error(failed).code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(joint_error({failed.data(), 1}).message, kPivot.message);
}

}  // namespace
}  // namespace geotherm::test
