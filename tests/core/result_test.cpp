// SPDX-License-Identifier: MIT
#include "geotherm/error.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace geotherm::test {
namespace {

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = 7;
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 7);
  const Result<int> bad = Error{ErrorCode::kBadFile, "line 3"};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::kBadFile);
  EXPECT_EQ(bad.error().message, "line 3");
}

TEST(Result, MovesWhatCannotBeCopied) {
  Result<std::unique_ptr<std::string>> held = std::make_unique<std::string>("x");
  const std::unique_ptr<std::string> taken = *std::move(held);
  EXPECT_EQ(*taken, "x");
}

TEST(Result, OfNothingIsSuccessUnlessToldOtherwise) {
  EXPECT_TRUE(Result<void>());
  EXPECT_FALSE(Result<void>(Error{ErrorCode::kCancelled, "stopped"}));
}

}  // namespace
}  // namespace geotherm::test
