// SPDX-License-Identifier: MIT
#include "engine/window/window.h"

#include <imgui.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/engine/window/window_fixture.h"
#include "tests/engine/window/x_client.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class Windows : public DisplayTest {};

TEST_F(Windows, WithoutADisplayAreAnErrorThatSaysWhy) {
  for (const char* const name : {":987", ""}) {
    ::setenv("DISPLAY", name, 1);
    const auto window = Window::open();
    ASSERT_FALSE(window) << name;
    EXPECT_EQ(window.error().code, ErrorCode::kNoDevice);
    const std::string& message = window.error().message;
    EXPECT_NE(message.find("X11"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  Window::wake();
}

TEST_F(Windows, OpenAgainAfterTheyWereClosed) {
  for (int turn = 0; turn < 3; ++turn) {
    const auto window = must(Window::open());
    EXPECT_FALSE(window->take_close());
  }
}

TEST_F(Windows, MayBeWokenWhenThereIsNone) {
  Window::wake();
  { const auto window = must(Window::open()); }
  Window::wake();
}

TEST_F(Windows, MayBeWokenFromAnotherThreadWhileTheyOpenAndClose) {
  std::jthread waker([](const std::stop_token& stop) {
    while (!stop.stop_requested()) Window::wake();
  });
  for (int turn = 0; turn < 3; ++turn) {
    const auto window = must(Window::open());
    window->wait(0);
  }
}

TEST_F(Windows, HaveTheSizeAndTheTitleTheyWereGiven) {
  const auto window = must(Window::open({"a title of its own", {400, 300}}));
  EXPECT_EQ(window->pixels(), glm::ivec2(400, 300));
  EXPECT_EQ(window->content_scale(), glm::vec2(1));
  xdotool("search --name '^a title of its own$' >/dev/null");
  window->set_title("another one");
  window->wait(0.01);
  xdotool("search --name '^another one$' >/dev/null");
  xdotool("search --class '^geotherm$' >/dev/null");
}

class WindowEvents : public WindowTest {
 protected:
  std::vector<std::string> dropped_from_outside(const std::string& uris) {
    std::vector<std::string> files;
    const std::jthread user([&] { drop("geotherm", uris); });
    EXPECT_TRUE(eventually([&] { return !(files = window_->take_dropped_files()).empty(); }));
    return files;
  }
};

TEST_F(WindowEvents, HoldTheFilesThatWereDropped) {
  const std::vector<std::string> expected = {"/models/a torus.obj", "/b.ply"};
  EXPECT_EQ(dropped_from_outside("file:///models/a%20torus.obj\r\nfile:///b.ply\r\n"), expected);
  EXPECT_TRUE(window_->take_dropped_files().empty());
}

TEST_F(WindowEvents, HoldTheFilesThatWereDroppedBesidePanels) {
  ImGuiContext* const context = ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  window_->connect_panels();
  EXPECT_EQ(dropped_from_outside("file:///b.ply\r\n"), std::vector<std::string>{"/b.ply"});
  target_.reset();
  window_.reset();
  ImGui::DestroyContext(context);
}

TEST_F(WindowEvents, SayThatTheWindowIsToBeClosed) {
  EXPECT_FALSE(window_->take_close());
  ask_to_close("geotherm");
  EXPECT_TRUE(eventually([&] { return window_->take_close(); }));
  EXPECT_FALSE(window_->take_close()) << "once";
}

class WindowWaiting : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!window_) return;
    while (window_->wait(0.3)) {  // until the window system has said all
    }
  }
};

TEST_F(WindowWaiting, EndsWhenTheTimeIsOver) {
  const auto begin = Clock::now();
  EXPECT_FALSE(window_->wait(0.2));
  EXPECT_GE(seconds_since(begin), 0.2);
}

TEST_F(WindowWaiting, LooksWithoutWaiting) {
  const auto begin = Clock::now();
  EXPECT_FALSE(window_->wait(0));
  EXPECT_LT(seconds_since(begin), 1);
}

TEST_F(WindowWaiting, EndsWhenAnotherThreadWakesIt) {
  for (const double seconds : {100.0, -1.0}) {
    const std::jthread waker([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      Window::wake();
    });
    EXPECT_TRUE(window_->wait(seconds));
  }
}

TEST_F(WindowWaiting, EndsAtOnceWhenItWasWokenBefore) {
  Window::wake();
  EXPECT_TRUE(window_->wait(100));
}

TEST_F(WindowWaiting, EndsWhenSomethingHappens) {
  xdotool("search --class geotherm windowsize 400 300");
  EXPECT_TRUE(window_->wait(100));
}

}  // namespace
}  // namespace geotherm::test
