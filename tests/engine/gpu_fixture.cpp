// SPDX-License-Identifier: MIT
#include "tests/engine/gpu_fixture.h"

#include <optional>

namespace geotherm::test {
namespace {

class GpuEnvironment final : public testing::Environment {
 public:
  explicit GpuEnvironment(bool required) : required_(required) { current() = this; }

  void TearDown() override { device_.reset(); }

  static GpuEnvironment*& current() {
    static GpuEnvironment* the_only_one = nullptr;
    return the_only_one;
  }

  const Result<engine::Device>& device() {
    if (!device_) device_ = engine::Device::open(validated());
    return *device_;
  }
  bool required() const { return required_; }

 private:
  bool required_;
  std::optional<Result<engine::Device>> device_;
};

}  // namespace

engine::DeviceOptions validated(std::uint64_t memory_limit) {
  engine::DeviceOptions options;
  options.validation = true;
  options.memory_limit = memory_limit;
  return options;
}

bool vulkan_is_required() { return GpuEnvironment::current()->required(); }

std::unique_ptr<testing::Environment> make_gpu_environment(bool required) {
  return std::make_unique<GpuEnvironment>(required);
}

const engine::Device& GpuTest::device() { return *GpuEnvironment::current()->device(); }

void GpuTest::SetUp() {
  GpuEnvironment& environment = *GpuEnvironment::current();
  if (const auto& device = environment.device(); !device) {
    if (environment.required()) FAIL() << device.error().message;
    GTEST_SKIP() << device.error().message;
  }
  messages_before_ = device().validation_messages().size();
}

void GpuTest::TearDown() {
  if (!GpuEnvironment::current()->device()) return;
  const auto messages = device().validation_messages();
  for (std::size_t i = messages_before_; i < messages.size(); ++i) ADD_FAILURE() << messages[i];
}

}  // namespace geotherm::test
