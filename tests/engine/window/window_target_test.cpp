// SPDX-License-Identifier: MIT
#include "engine/window/window_target.h"

#include "engine/vulkan/frame_recorder.h"
#include "tests/engine/measure.h"
#include "tests/engine/window/window_fixture.h"
#include "tests/engine/window/x_client.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class WindowDrawing : public WindowTest {
 protected:
  /// Expects that the window comes to show this.
  void expect_shown(const Image& expected) {
    EXPECT_TRUE(eventually([&] { return content().pixels == expected.pixels; }))
        << different_pixels(content(), expected, 0);
  }
  /// Draws the scene laid out for the window and expects to see it.
  void expect_scene(Stage& stage) {
    ASSERT_TRUE(must(target_->follow_window()));
    ASSERT_EQ(target_->extent(), window_->pixels());
    stage.look({.azimuth = 30, .elevation = 20}, target_->extent());
    ASSERT_TRUE(draw(stage));
    expect_shown(stage.draw());
  }
};

TEST_F(WindowDrawing, ShowsThePictureThatIsDrawnInMemory) {
  Stage stage = full_stage(*device_);
  ASSERT_TRUE(draw(stage, some_text()));
  EXPECT_EQ(target_->extent(), kSize);
  expect_shown(stage.draw(some_text()));
}

TEST_F(WindowDrawing, ShowsEachFrame) {
  Stage stage = full_stage(*device_);
  for (const float azimuth : {10.0F, 100.0F, 200.0F, 300.0F, 350.0F}) {
    stage.look({.azimuth = azimuth}, kSize);
    stage.renderer.set_samples(azimuth < 150 ? 1 : 4);
    ASSERT_TRUE(draw(stage));
    expect_shown(stage.draw());
  }
}

TEST_F(WindowDrawing, PutsThePictureAtItsCornerAndPanelsBeside) {
  Stage stage = full_stage(*device_);
  must(stage.renderer.set_panel_font({1, 1, {255}, 1}));
  const glm::ivec2 corner(100, 20);
  stage.look({}, kSize - corner);
  PanelDraw panels;
  panels.vertices = {
      {{0, 0}, {0, 0}, 0xFF102030}, {{200, 0}, {0, 0}, 0xFF102030}, {{0, 480}, {0, 0}, 0xFF102030}};
  panels.indices = {0, 1, 2};
  panels.commands = {{{0, 0, 100, 240}, 0, 3, 0}};
  target_->set_picture_corner(corner);
  ASSERT_TRUE(draw(stage, some_text(), &panels));
  expect_shown(stage.draw_into(kSize, corner, some_text(), &panels));
}

TEST_F(WindowDrawing, FollowsTheWindowsSize) {
  Stage stage = full_stage(*device_, 1);
  for (const glm::ivec2 size : {glm::ivec2(500, 300), glm::ivec2(200, 700), glm::ivec2(1000, 740),
                                glm::ivec2(1, 1), glm::ivec2(3, 200), glm::ivec2(320, 240)}) {
    resize(size);
    expect_scene(stage);
  }
}

TEST_F(WindowDrawing, TakesNoMoreMemoryHoweverOftenTheWindowIsResized) {
  Stage stage = full_stage(*device_, 4);
  expect_scene(stage);
  const std::uint64_t before = device_->memory_used();
  for (int turn = 0; turn < 5; ++turn) {
    resize({400 + 50 * turn, 300});
    ASSERT_TRUE(draw(stage));
    resize(kSize);
    ASSERT_TRUE(draw(stage));
    EXPECT_EQ(device_->memory_used(), before);
  }
}

TEST_F(WindowDrawing, GoesOnWhileTheWindowIsBeingResized) {
  Stage stage = full_stage(*device_, 1);
  std::string words = "search --class geotherm";
  for (int step = 0; step < 150; ++step) {
    words += " sleep 0.003 windowsize " + std::to_string(100 + 7 * (step * 37 % 100)) + " " +
             std::to_string(80 + 5 * (step * 53 % 100));
  }
  xdotool(words + " windowsize 450 350 &");
  EXPECT_TRUE(eventually([&] {
    draw(stage);
    return window_->pixels() == glm::ivec2(450, 350);
  }));
  expect_scene(stage);
}

TEST_F(WindowDrawing, StopsWhileTheWindowIsMinimised) {
  Stage stage = full_stage(*device_, 1);
  expect_scene(stage);
  mark_minimised("geotherm", true);
  ASSERT_TRUE(eventually([&] { return window_->pixels() == glm::ivec2(0); }));
  EXPECT_FALSE(draw(stage));
  EXPECT_FALSE(draw(stage));
  mark_minimised("geotherm", false);
  ASSERT_TRUE(eventually([&] { return window_->pixels() == kSize; }));
  expect_scene(stage);
}

TEST_F(WindowDrawing, GoesOnWhileTheWindowIsHidden) {
  Stage stage = full_stage(*device_, 1);
  expect_scene(stage);
  xdotool("search --class geotherm windowunmap --sync");
  for (int frame = 0; frame < 10; ++frame) (void)draw(stage);
  xdotool("search --class geotherm windowmap --sync");
  ASSERT_TRUE(eventually([&] { return window_->pixels() == kSize; }));
  expect_scene(stage);
}

/// As when preparing a frame fails after it was begun.
TEST_F(WindowDrawing, GoesOnAfterAFrameThatWasNotEnded) {
  Stage stage = full_stage(*device_, 1);
  TargetFrame frame;
  ASSERT_TRUE(must(target_->follow_window()));
  must(target_->begin(frame));
  expect_scene(stage);
  ASSERT_TRUE(must(target_->follow_window()));
  must(target_->begin(frame));
  resize({400, 300});
  expect_scene(stage);
  must(target_->begin(frame));  // and is not ended before the target
}

TEST_F(WindowDrawing, TakesFramesWithoutLookingAtTheWindow) {
  Stage stage = full_stage(*device_, 1);
  ASSERT_TRUE(must(target_->follow_window()));
  for (int frame = 0; frame < 5; ++frame) must(stage.renderer.render(*target_, stage.scene));
  expect_shown(stage.draw());
  resize({400, 300});
  for (int frame = 0; frame < 5; ++frame) must(stage.renderer.render(*target_, stage.scene));
}

TEST_F(WindowDrawing, IsMadeAgainForTheSameWindow) {
  Stage stage = full_stage(*device_, 1);
  for (int turn = 0; turn < 3; ++turn) {
    expect_scene(stage);
    target_.reset();
    target_ = must(WindowTarget::build(*device_, *window_));
  }
}

}  // namespace
}  // namespace geotherm::test
