// SPDX-License-Identifier: MIT
#include "tests/engine/window/window_fixture.h"

#include <chrono>
#include <cstring>

namespace geotherm::test {

using namespace geotherm::engine;

void DisplayTest::SetUp() {
  try {
    display_.emplace();
  } catch (const std::runtime_error& error) {
    if (vulkan_is_required()) FAIL() << error.what();
    GTEST_SKIP() << error.what();
  }
}

void WindowTest::SetUp() {
  DisplayTest::SetUp();
  if (!display_) return;
  WindowOptions options;
  options.size = kSize;
  auto window = Window::open(options);
  if (!window) {
    if (vulkan_is_required()) FAIL() << window.error().message;
    GTEST_SKIP() << window.error().message;
  }
  window_ = *std::move(window);
  DeviceOptions wishes = validated();
  wishes.window = window_.get();
  device_ = must(Device::open(wishes));
  target_ = must(WindowTarget::build(*device_, *window_));
}

void WindowTest::TearDown() {
  target_.reset();
  if (!device_) return;
  for (const std::string& message : device_->validation_messages()) ADD_FAILURE() << message;
}

bool WindowTest::eventually(const std::function<bool()>& so) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(10);
  while (!so()) {
    if (Clock::now() > end) return false;
    window_->wait(0.01);
  }
  return true;
}

void WindowTest::resize(glm::ivec2 size) {
  xdotool("search --class geotherm windowsize " + std::to_string(size.x) + " " +
          std::to_string(size.y));
  ASSERT_TRUE(eventually([&] { return window_->pixels() == size; }));
}

Image WindowTest::content() const {
  const Image screen = display_->screen();
  const glm::ivec2 size = window_->pixels();
  Image image;
  image.width = size.x;
  image.height = size.y;
  for (int y = 0; y < size.y; ++y) {  // without a window manager it is in the upper left corner
    image.pixels.insert(image.pixels.end(), screen.at(0, y), screen.at(0, y) + 4 * size.x);
  }
  return image;
}

bool WindowTest::draw(Stage& stage, const Overlay& overlay, const PanelDraw* panels) {
  if (!must(target_->follow_window())) return false;
  must(stage.renderer.render(*target_, stage.scene, overlay, panels));
  return true;
}

}  // namespace geotherm::test
