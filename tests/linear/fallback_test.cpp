// SPDX-License-Identifier: MIT
#include "solver/linear/backend_registry.h"

#include <gtest/gtest.h>

#include "geotherm/backend.h"

namespace geotherm::test {
namespace {

const Error kFirstPivot = {ErrorCode::kNumericalFailure, "pivot 3 of 8", {"try another"}, "first"};

TEST(Fallback, HasTheMessageAsItsReason) {
  const Fallback failed = {"first", kFirstPivot};
  EXPECT_EQ(failed.backend, "first");
  EXPECT_EQ(failed.error.message, "pivot 3 of 8");
  EXPECT_EQ(sentence(failed.error), "first: pivot 3 of 8; try another");
}

TEST(Fallback, GoesThroughTheOthersInTheirOrder) {
  const std::vector<std::string> names = backend_names();
  std::vector<Fallback> failed = {Fallback{names.back(), kFirstPivot}};
  std::vector<std::string> tried;
  for (;;) {
    const std::string next = next_backend(failed, FallbackPolicy::kAny);
    if (next.empty()) break;
    tried.push_back(next);
    failed.push_back(Fallback{next, kFirstPivot});
  }
  EXPECT_EQ(tried, std::vector<std::string>(names.begin(), names.end() - 1));
}

TEST(Fallback, AsksForAFactorOrForNone) {
  const std::vector<Fallback> failed = {Fallback{backend_names().front(), kFirstPivot}};
  EXPECT_EQ(next_backend(failed, FallbackPolicy::kFactorless), "cg");
  EXPECT_FALSE((*find_backend(next_backend({}, FallbackPolicy::kFactored)))->iterative());
  EXPECT_EQ(next_backend(failed, FallbackPolicy::kNone), "");
}

TEST(Fallback, SaysWhoFailedWhyAndWhoTookOver) {
  const std::vector<Fallback> failed = {
      Fallback{"first", kFirstPivot},
      Fallback{"second", {ErrorCode::kOutOfMemory, "2 GB", {"less"}, "second"}}};
  EXPECT_EQ(takeover_text(failed, "third"),
            "first failed: pivot 3 of 8; second failed: 2 GB; third took over");
  EXPECT_EQ(sentence(joint_error(failed)), "first: pivot 3 of 8, second: 2 GB; less");
  EXPECT_EQ(joint_error(failed).code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(sentence(joint_error({failed.data(), 1})), sentence(kFirstPivot));
}

}  // namespace
}  // namespace geotherm::test
