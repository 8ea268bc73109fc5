// SPDX-License-Identifier: MIT
#include "engine/device.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "engine/vulkan/device_state.h"
#include "engine/vulkan/pipelines.h"
#include "engine/vulkan/vulkan.h"
#include "tests/engine/gpu_fixture.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class Devices : public GpuTest {
 protected:
  static DeviceOptions called(const std::string& name) {
    DeviceOptions options;
    options.name = name;
    return options;
  }
};

TEST_F(Devices, AreListedWithOneThatIsChosen) {
  const auto devices = must(list_devices());
  ASSERT_FALSE(devices.empty());
  ASSERT_EQ(std::count_if(devices.begin(), devices.end(), [](auto& d) { return d.chosen; }), 1);
  const auto chosen =
      std::find_if(devices.begin(), devices.end(), [](const auto& d) { return d.chosen; });
  EXPECT_TRUE(chosen->lacks.empty());
  EXPECT_EQ(chosen->name, device().info().name);
}

/// A picture that is saved has another format than the window; both are drawn in turn.
TEST_F(Devices, KeepThePipelinesOfEachFormat) {
  Pipelines pipelines(device().state());
  const auto made_for = [&](vk::Format format) {
    pipelines.use(format, vk::SampleCountFlagBits::e1);
    return pipelines.overlay();
  };
  const vk::Pipeline saved = made_for(vk::Format::eR8G8B8A8Unorm);
  const vk::Pipeline shown = made_for(vk::Format::eB8G8R8A8Unorm);
  EXPECT_NE(saved, shown);
  EXPECT_EQ(made_for(vk::Format::eR8G8B8A8Unorm), saved);
  EXPECT_EQ(made_for(vk::Format::eB8G8R8A8Unorm), shown);
}

TEST_F(Devices, SayWhatTheyAre) {
  for (const DeviceInfo& info : must(list_devices())) {
    EXPECT_FALSE(info.name.empty());
    EXPECT_GE(info.api_major, 1U);
    EXPECT_GT(info.memory, 0U);
    EXPECT_EQ(info.software, info.kind == "software") << info.name;
    EXPECT_TRUE(info.software || info.name.find("llvmpipe") == std::string::npos);
  }
}

TEST_F(Devices, AreOpenedByAPartOfTheirNameInAnyCase) {
  std::string part = device().info().name.substr(0, 4);
  std::transform(part.begin(), part.end(), part.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  EXPECT_EQ(must(Device::open(called(part))).info().name, device().info().name);
}

TEST_F(Devices, OfAnUnknownNameAreAnErrorThatListsThem) {
  const auto opened = Device::open(called("no such device"));
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kNoDevice);
  EXPECT_NE(opened.error().message.find("no such device"), std::string::npos);
  const std::string told = sentence(opened.error());
  EXPECT_NE(told.find(device().info().name), std::string::npos) << told;
}

TEST_F(Devices, MayBeOpenSeveralAtATime) {
  const Device second = must(Device::open({}));
  const Device third = must(Device::open({}));
  EXPECT_NE(second.state(), third.state());
  EXPECT_EQ(second.info().name, third.info().name);
  EXPECT_EQ(second.memory_used(), 0U);
}

/// The environment's variable, until the end of a test.
class Setting {
 public:
  Setting(const char* name, const char* value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    ::setenv(name, value, 1);
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;
  ~Setting() {
    if (before_) {
      ::setenv(name_, before_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(Devices, AreAnErrorWithTheCureWithoutADriver) {
  const Setting setting("VK_DRIVER_FILES", "/no/such/driver.json");
  const auto devices = list_devices();
  const auto opened = Device::open();
  ASSERT_FALSE(devices);
  ASSERT_FALSE(opened);
  for (const Error& error : {devices.error(), opened.error()}) {
    EXPECT_EQ(error.code, ErrorCode::kNoDevice);
    EXPECT_NE(sentence(error).find("mesa-vulkan-drivers"), std::string::npos) << sentence(error);
  }
}

/// A window system that no device can show anything in.
class BlindWindows final : public Presentation {
 public:
  std::vector<const char*> instance_extensions() const override { return {}; }
  bool can_present(vk::Instance, vk::PhysicalDevice, std::uint32_t) const override { return false; }
  vk::SurfaceKHR make_surface(vk::Instance) const override { return {}; }
};

TEST_F(Devices, ThatCannotShowPicturesInWindowsAreRefusedForThem) {
  const Instance instance(false);
  const BlindWindows windows;
  const auto candidates = examine_devices(instance.instance, &windows);
  ASSERT_FALSE(candidates.empty());
  for (const Candidate& candidate : candidates) EXPECT_FALSE(candidate.info.lacks.empty());
  try {
    (void)choose_device(candidates, "");
    FAIL() << "one was chosen";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().code, ErrorCode::kNoDevice);
    EXPECT_NE(failure.error().message.find("cannot show pictures in windows"), std::string::npos)
        << failure.error().message;
  }
  EXPECT_TRUE(examine_devices(instance.instance).front().info.lacks.empty());
}

TEST_F(Devices, SayNothingWhenNothingIsWrong) {
  const Device own = must(Device::open(validated()));
  EXPECT_TRUE(own.validation_messages().empty());
}

/// Without this the other tests would prove nothing.
TEST_F(Devices, ReportWrongCallsWhenTheyAreValidated) {
  const Device own = must(Device::open(validated()));
  try {
    const vk::raii::Buffer empty(
        own.state()->device, vk::BufferCreateInfo({}, 0, vk::BufferUsageFlagBits::eVertexBuffer));
  } catch (const vk::SystemError&) {
    // What the driver makes of it is its own affair.
  }
  const auto messages = own.validation_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages.front().find("size"), std::string::npos) << messages.front();
}

TEST_F(Devices, ReportMissingBarriersWhenTheyAreValidated) {
  const Device own = must(Device::open(validated()));
  const Device::State& state = *own.state();
  const auto usage = vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst;
  const Buffer a(state.memory, 64, usage, Home::kHost);
  const Buffer b(state.memory, 64, usage, Home::kHost);
  state.run([&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*a.buffer, *b.buffer, vk::BufferCopy(0, 0, 64));
    commands.copyBuffer(*b.buffer, *a.buffer, vk::BufferCopy(0, 0, 64));
  });
  const auto messages = own.validation_messages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages.front().find("SYNC-HAZARD"), std::string::npos) << messages.front();
}

}  // namespace
}  // namespace geotherm::test
