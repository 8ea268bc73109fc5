// SPDX-License-Identifier: MIT
#include <imgui.h>

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "tests/engine/window/window_fixture.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class PanelInputs : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!window_) return;
    context_ = ImGui::CreateContext();
    io().IniFilename = nullptr;
    io().Fonts->Build();
    window_->connect_panels();
    frame();
  }
  void TearDown() override {
    WindowTest::TearDown();
    window_.reset();  // before the context
    if (context_ != nullptr) ImGui::DestroyContext(context_);
  }

  static ImGuiIO& io() { return ImGui::GetIO(); }
  void frame() {
    window_->begin_panels();
    ImGui::NewFrame();
    ImGui::EndFrame();
  }
  bool eventually_in_a_frame(const std::function<bool()>& so) {
    return eventually([&] {
      frame();
      return so();
    });
  }

  ImGuiContext* context_ = nullptr;
};

TEST_F(PanelInputs, KnowTheWindowsSize) {
  EXPECT_EQ(io().DisplaySize.x, kSize.x);
  EXPECT_EQ(io().DisplaySize.y, kSize.y);
  resize({500, 300});
  frame();
  EXPECT_EQ(io().DisplaySize.x, 500);
  EXPECT_EQ(io().DisplayFramebufferScale.x, 1);
  EXPECT_GT(io().DeltaTime, 0);
}

TEST_F(PanelInputs, FollowTheMouse) {
  xdotool("mousemove 123 45");
  EXPECT_TRUE(
      eventually_in_a_frame([&] { return io().MousePos.x == 123 && io().MousePos.y == 45; }));
  xdotool("mousedown 1");
  EXPECT_TRUE(eventually_in_a_frame([&] { return io().MouseDown[0]; }));
  xdotool("mouseup 1");
  EXPECT_TRUE(eventually_in_a_frame([&] { return !io().MouseDown[0]; }));
  xdotool("click 4");
  EXPECT_TRUE(eventually([&] {
    window_->begin_panels();
    const bool turned = io().MouseWheel > 0;  // the frame's end clears it
    ImGui::NewFrame();
    ImGui::EndFrame();
    return turned;
  }));
}

/// What happens while a slow frame is drawn is seen in the frames that follow.
TEST_F(PanelInputs, LoseNoKeyAndNoClickBetweenFrames) {
  xdotool("mousemove 100 100 search --class geotherm windowfocus --sync");
  while (window_->wait(0.2)) {
  }
  frame();
  xdotool("mousemove 120 110 click 1 mousemove 300 200 key F5 click 1");
  ASSERT_TRUE(eventually([&] {
    window_->wait(0.05);
    return window_->has_more_input();
  }));
  while (window_->wait(0.2)) {
  }
  constexpr int kF5 = 294;
  std::vector<std::pair<float, float>> clicks;
  int presses = 0;
  for (int i = 0; i < 20; ++i) {
    frame();
    if (io().MouseClicked[0]) clicks.emplace_back(io().MousePos.x, io().MousePos.y);
    presses += ImGui::IsKeyPressed(kF5, false) ? 1 : 0;
  }
  EXPECT_EQ(clicks, (std::vector<std::pair<float, float>>{{120, 110}, {300, 200}}));
  EXPECT_EQ(presses, 1);
  EXPECT_FALSE(io().MouseDown[0]);
  EXPECT_FALSE(window_->has_more_input());
}

TEST_F(PanelInputs, SeeAKeyTogetherWithItsModifier) {
  xdotool("mousemove 100 100 search --class geotherm windowfocus --sync");
  while (window_->wait(0.2)) {
  }
  frame();
  for (const char* delay : {"0", "15", "60"}) {
    xdotool(std::string("key --delay ") + delay + " ctrl+q");
    int seen = 0;
    for (int i = 0; i < 40; ++i) {
      window_->wait(0.01);
      frame();
      seen += io().KeyCtrl && ImGui::IsKeyPressed('Q', false) ? 1 : 0;
    }
    EXPECT_EQ(seen, 1) << delay;
    EXPECT_FALSE(io().KeyCtrl);
  }
}

TEST_F(PanelInputs, KnowADoubleClickHoweverSlowTheFramesAre) {
  xdotool("mousemove 100 100");
  while (window_->wait(0.2)) {
  }
  frame();
  xdotool("click --repeat 2 --delay 60 1");
  ASSERT_TRUE(eventually([&] {
    window_->wait(0.05);
    return window_->has_more_input();
  }));
  while (window_->wait(0.2)) {
  }
  bool twice = false;
  for (int i = 0; i < 6; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));  // a slow frame
    frame();
    twice |= io().MouseDoubleClicked[0];
  }
  EXPECT_TRUE(twice);
}

TEST_F(PanelInputs, ReadTheKeyboard) {
  xdotool("mousemove 100 100 search --class geotherm windowfocus --sync");
  xdotool("keydown space");
  EXPECT_TRUE(
      eventually_in_a_frame([&] { return ImGui::IsKeyDown(ImGui::GetKeyIndex(ImGuiKey_Space)); }));
  xdotool("keyup space");
  EXPECT_TRUE(
      eventually_in_a_frame([&] { return !ImGui::IsKeyDown(ImGui::GetKeyIndex(ImGuiKey_Space)); }));
}

/// The window still hears what ImGui hears.
TEST_F(PanelInputs, LeaveTheWindowItsEvents) {
  while (window_->wait(0.3)) {
  }
  xdotool("mousemove 30 30 click 1");
  EXPECT_TRUE(eventually([&] { return window_->wait(0); }));
}

TEST_F(PanelInputs, EndWithTheWindow) {
  target_.reset();
  window_.reset();
  EXPECT_EQ(io().BackendPlatformUserData, nullptr);
  ImGui::SetClipboardText("nobody takes this");
  EXPECT_STREQ(ImGui::GetClipboardText(), "");
}

}  // namespace
}  // namespace geotherm::test
