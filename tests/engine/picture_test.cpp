// SPDX-License-Identifier: MIT
#include "engine/renderer.h"

#include "engine/scene/colours.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

class Picture : public GpuTest {};

class Tiles : public Picture, public testing::WithParamInterface<int> {};

TEST_P(Tiles, MakeTheSamePictureAsTheWhole) {
  Stage stage = full_stage(device());
  const Overlay overlay = some_text();
  const Image whole = stage.draw(overlay);
  const Image tiled =
      must(draw_picture(device(), stage.renderer, stage.scene, overlay, GetParam()));
  EXPECT_LE(different_pixels(whole, tiled, 1), 0.005);
}

INSTANTIATE_TEST_SUITE_P(All, Tiles, testing::Values(64, 100, 250),
                         [](const auto& test) { return std::to_string(test.param); });

class PictureSize : public Picture, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(PictureSize, MayBeAnyThatFits) {
  Stage stage = full_stage(device());
  const glm::vec2 size(GetParam().first, GetParam().second);
  stage.look({}, size);
  stage.scene.markers.visible = false;
  const Image image = stage.draw();
  EXPECT_EQ(image.width, GetParam().first);
  EXPECT_EQ(image.height, GetParam().second);
  EXPECT_EQ(image.pixels.size(), 4U * static_cast<std::size_t>(image.width * image.height));
  EXPECT_GT(darkness(image, image.width / 2, image.height / 2), 0.01);  // the model is there
}

INSTANTIATE_TEST_SUITE_P(All, PictureSize,
                         testing::Values(std::pair(1, 1), std::pair(37, 19), std::pair(3, 200),
                                         std::pair(2050, 5)),
                         [](const auto& test) {
                           return std::to_string(test.param.first) + "x" +
                                  std::to_string(test.param.second);
                         });

TEST_F(Picture, ThatIsTooLargeIsRefusedWithTheNumbers) {
  Stage stage = full_stage(device());
  stage.look({}, {20000, 10});
  const auto image = draw_picture(device(), stage.renderer, stage.scene);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kBadInput);
  const std::string told = sentence(image.error());
  EXPECT_NE(told.find("20000x10"), std::string::npos) << told;
  EXPECT_NE(told.find("16384"), std::string::npos) << told;
}

TEST_F(Picture, HasOneOrFourSamples) {
  for (const int samples : {0, 2, 3, 8, -1}) {
    const auto renderer = Renderer::build(device(), samples);
    ASSERT_FALSE(renderer);
    EXPECT_EQ(renderer.error().code, ErrorCode::kBadInput);
    EXPECT_NE(renderer.error().message.find(std::to_string(samples)), std::string::npos);
  }
  for (const int samples : {1, 4}) EXPECT_TRUE(Renderer::build(device(), samples)) << samples;
}

TEST_F(Picture, RepeatsBitForBit) {
  Stage first = full_stage(device());
  const Image image = first.draw(some_text());
  EXPECT_EQ(first.draw(some_text()).pixels, image.pixels);
  Stage second = full_stage(device());
  EXPECT_EQ(second.draw(some_text()).pixels, image.pixels);
}

TEST_F(Picture, DoesNotDependOnWhatWasDrawnBefore) {
  Stage stage = full_stage(device());
  const Image image = stage.draw();
  Stage other = full_stage(device());
  other.scene.surface.wire = false;
  other.scene.arrows.primary = false;
  other.look({.azimuth = 200}, {100, 300});
  (void)other.draw(some_text());
  other.scene = stage.scene;
  EXPECT_EQ(other.draw().pixels, image.pixels);
}

TEST_F(Picture, IsTheSameInsideWithOneAndFourSamples) {
  const auto plain = [](int samples) {
    Stage stage(device(), model_of(sphere(3)), samples);
    stage.paint(stage.model.values([](const glm::vec3& p) { return 0.5F + 0.5F * p.y; }));
    stage.scene.light = Light::kThreePoint;
    return stage.draw();
  };
  const Image one = plain(1);
  const Image four = plain(4);
  for (int y = 70; y < 170; ++y) {
    for (int x = 110; x < 210; ++x) {
      ASSERT_LE(difference(colour_at(one, x, y), colour_at(four, x, y)), 2.5F / 255);
    }
  }
  // And smoother along the border.
  EXPECT_GT(different_pixels(one, four, 20), 0.001);
}

TEST_F(Picture, ShowsNewValuesOnTheSameModel) {
  Stage stage(device(), plane_model(2, 2));
  stage.paint(std::vector<float>(stage.model.positions.size(), 0));
  const glm::vec3 before = colour_at(stage.draw(), 160, 120);
  stage.paint(std::vector<float>(stage.model.positions.size(), 1));
  const glm::vec3 after = colour_at(stage.draw(), 160, 120);
  EXPECT_LE(difference(before, engine::colour_at(colour_maps().front(), 0)), 0.01F);
  EXPECT_LE(difference(after, engine::colour_at(colour_maps().front(), 1)), 0.01F);
}

}  // namespace
}  // namespace geotherm::test
