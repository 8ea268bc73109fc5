// SPDX-License-Identifier: MIT
#include "geotherm/error.h"

#include <gtest/gtest.h>

namespace geotherm::test {
namespace {

const Hint kHint = {"use ", SettingHint{"boundary", {"neumann", "average"}}, ", or raise ",
                    SettingHint{"memory-limit"}};

TEST(Hint, IsWordsWithTheNamesAndValuesOfItsSettings) {
  EXPECT_EQ(hint_text(kHint), "use boundary neumann or average, or raise memory-limit");
  EXPECT_EQ(hint_text(kHint, "--"), "use --boundary neumann or average, or raise --memory-limit");
  EXPECT_EQ(hint_text({}), "");
}

TEST(Hint, OffersTheSettingsThatHaveValues) {
  EXPECT_EQ(settings_of(kHint), (std::vector<SettingHint>{{"boundary", {"neumann", "average"}}}));
  EXPECT_TRUE(settings_of({"take a mesh with fewer faces"}).empty());
}

TEST(Hint, FollowsTheMessageInASentence) {
  const Error error{ErrorCode::kOutOfMemory,
                    "ran out of memory",
                    {"try ", SettingHint{"backend", {"cg"}}},
                    "native"};
  EXPECT_EQ(sentence(error), "native: ran out of memory; try backend cg");
  EXPECT_EQ(sentence(error, "--"), "native: ran out of memory; try --backend cg");
  EXPECT_EQ(sentence(Error{ErrorCode::kCancelled, "stopped"}), "stopped");
  EXPECT_EQ(sentence(Warning{"it is wrong", {"use ", SettingHint{"method", {"exact"}}}}, "--"),
            "it is wrong; use --method exact");
}

}  // namespace
}  // namespace geotherm::test
