// SPDX-License-Identifier: MIT
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class Samples : public GpuTest, public testing::WithParamInterface<int> {};

TEST_P(Samples, ThatAreSetLaterGiveThePictureOfARendererBuiltWithThem) {
  Stage built = full_stage(device(), GetParam());
  Stage changed = full_stage(device(), GetParam() == 1 ? 4 : 1);
  EXPECT_NE(changed.draw(some_text()).pixels, built.draw(some_text()).pixels);
  changed.renderer.set_samples(GetParam());
  EXPECT_EQ(changed.draw(some_text()).pixels, built.draw(some_text()).pixels);
}

INSTANTIATE_TEST_SUITE_P(All, Samples, testing::Values(1, 4),
                         [](const auto& test) { return std::to_string(test.param); });

class SampleSwitch : public GpuTest {};

TEST_F(SampleSwitch, MayBeTurnedAtEachFrame) {
  Stage stage = full_stage(device(), 4);
  const Image four = stage.draw();
  stage.renderer.set_samples(1);
  const Image one = stage.draw();
  for (int turn = 0; turn < 4; ++turn) {
    stage.renderer.set_samples(4);
    ASSERT_EQ(stage.draw().pixels, four.pixels);
    stage.renderer.set_samples(1);
    ASSERT_EQ(stage.draw().pixels, one.pixels);
  }
}

/// What one count needs is kept while the other one draws.
TEST_F(SampleSwitch, TakesNoMemoryOnceBothHaveDrawn) {
  Stage stage = full_stage(device(), 4);
  (void)stage.draw();
  const std::uint64_t with_four = device().memory_used();
  stage.renderer.set_samples(1);
  (void)stage.draw();
  const std::uint64_t with_both = device().memory_used();
  EXPECT_GT(with_both, with_four);
  stage.renderer.set_samples(4);
  (void)stage.draw();
  EXPECT_EQ(device().memory_used(), with_both);
}

TEST_F(SampleSwitch, LeavesNothingOfAnotherSizeBehind) {
  Stage stage = full_stage(device(), 1);
  stage.scene.arrows.primary = false;  // their buffer grows with the picture
  (void)stage.draw();
  const std::uint64_t small = device().memory_used();
  stage.renderer.set_samples(4);
  stage.look({}, {640, 480});
  (void)stage.draw();
  stage.renderer.set_samples(1);
  stage.look({}, kSmallPicture);
  (void)stage.draw();
  EXPECT_EQ(device().memory_used(), small);
}

}  // namespace
}  // namespace geotherm::test
