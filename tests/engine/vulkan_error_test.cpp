// SPDX-License-Identifier: MIT
#include "engine/vulkan/vulkan.h"

#include <gtest/gtest.h>

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

struct Status {
  vk::Result status;
  ErrorCode code;
};
void PrintTo(const Status& status, std::ostream* out) { *out << vk::to_string(status.status); }

class VulkanError : public testing::TestWithParam<Status> {};

TEST_P(VulkanError, SaysOnOneLineWhatWasDoneAndTheCure) {
  const Error error = error_of(GetParam().status, "drawing a picture");
  EXPECT_EQ(error.code, GetParam().code);
  EXPECT_EQ(error.message.rfind("drawing a picture: ", 0), 0U) << error.message;
  EXPECT_EQ(sentence(error).find('\n'), std::string::npos);
  EXPECT_FALSE(error.hint.empty()) << error.message;
}

TEST_P(VulkanError, IsWhatBecomesOfAnException) {
  const Result<void> result =
      guarded("drawing", [] { check(GetParam().status, "vkQueueSubmit2"); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(
    All, VulkanError,
    testing::Values(Status{vk::Result::eErrorDeviceLost, ErrorCode::kNoDevice},
                    Status{vk::Result::eErrorOutOfDeviceMemory, ErrorCode::kOutOfMemory},
                    Status{vk::Result::eErrorOutOfHostMemory, ErrorCode::kOutOfMemory},
                    Status{vk::Result::eErrorIncompatibleDriver, ErrorCode::kNoDevice},
                    Status{vk::Result::eErrorInitializationFailed, ErrorCode::kNoDevice}),
    [](const auto& test) { return vk::to_string(test.param.status); });

TEST(Guarded, LetsNoExceptionOut) {
  const auto failed = guarded("drawing", []() -> Result<int> {
    throw Failure({ErrorCode::kBadInput, "3 samples"});
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "3 samples");
  const auto starved = guarded("drawing", []() -> Result<int> { throw std::bad_alloc(); });
  ASSERT_FALSE(starved);
  EXPECT_EQ(starved.error().code, ErrorCode::kOutOfMemory);
}

TEST(Guarded, PassesOnWhatWentWell) {
  EXPECT_EQ(*guarded("drawing", []() -> Result<int> { return 7; }), 7);
  EXPECT_TRUE(guarded("drawing", [] {}));
}

}  // namespace
}  // namespace geotherm::test
