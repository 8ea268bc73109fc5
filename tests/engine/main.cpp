// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "tests/engine/gpu_fixture.h"

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  const char* const wish = std::getenv("GEOTHERM_REQUIRE_VULKAN");
  bool required = wish != nullptr && std::string_view(wish) == "1";
  for (int i = 1; i < count; ++i) required |= std::string_view(words[i]) == "--require-vulkan";
  testing::AddGlobalTestEnvironment(geotherm::test::make_gpu_environment(required).release());
  return RUN_ALL_TESTS();
}
