// SPDX-License-Identifier: MIT
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr glm::vec3 kPaleOrange(1, 0.5F, 0.25F);

class Background : public GpuTest {
 protected:
  /// A slanted square: borders that pass through pixels.
  Stage slanted() {
    Model model = square_model(0.5F, 0);
    for (auto& p : model.positions) p = {0.9F * p.x - 0.3F * p.y, 0.3F * p.x + 0.9F * p.y, 0};
    Stage stage(device(), std::move(model), 4);
    Orbit orbit = kFromFront;
    orbit.zoom = 0.8F;
    stage.look(orbit);
    stage.scene.surface.colour = kPaleOrange;
    return stage;
  }
};

TEST_F(Background, IsExactlyTheColourThatWasAskedFor) {
  Stage stage = slanted();
  for (const glm::vec4& colour : {glm::vec4(1), glm::vec4(26, 28, 33, 255) / 255.0F}) {
    stage.scene.background = colour;
    const Image image = stage.draw();
    for (const auto& [x, y] : {std::pair(0, 0), {319, 0}, {0, 239}, {319, 239}}) {
      for (int k = 0; k < 3; ++k) EXPECT_EQ(image.at(x, y)[k], std::lround(255 * colour[k]));
      EXPECT_EQ(image.at(x, y)[3], 255);
    }
  }
}

TEST_F(Background, LetsThroughWhatIsNotTheModel) {
  Stage stage = slanted();
  stage.scene.background = {1, 1, 1, 0};
  const Image image = stage.draw();
  for (const auto& [x, y] : {std::pair(0, 0), {319, 0}, {0, 239}, {319, 239}}) {
    EXPECT_EQ(image.at(x, y)[3], 0);
  }
  EXPECT_EQ(image.at(160, 120)[3], 255);
}

TEST_F(Background, DoesNotDarkenTheBorderOfTheModel) {
  Stage stage = slanted();
  stage.scene.background = {1, 1, 1, 0};
  const Image image = stage.draw();
  int border = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int alpha = image.at(x, y)[3];
      if (alpha == 0 || alpha == 255) continue;
      ++border;
      // 8 bits of a quarter of the coverage at least.
      EXPECT_LE(difference(colour_at(image, x, y), kPaleOrange), 2.5F / 255) << x << " " << y;
    }
  }
  EXPECT_GE(border, 200);
}

TEST_F(Background, MixesWithTheModelAlongItsBorder) {
  Stage stage = slanted();
  const Image on_white = stage.draw();
  stage.scene.background = {1, 1, 1, 0};
  const Image clear = stage.draw();
  for (int y = 0; y < clear.height; ++y) {
    for (int x = 0; x < clear.width; ++x) {
      const float alpha = clear.at(x, y)[3] / 255.0F;
      const glm::vec3 mixed = glm::mix(glm::vec3(1), colour_at(clear, x, y), alpha);
      ASSERT_LE(difference(colour_at(on_white, x, y), mixed), 2.5F / 255) << x << " " << y;
    }
  }
}

TEST_F(Background, IsAllThereIsWithoutASurface) {
  Stage stage = slanted();
  stage.scene.surface.visible = false;
  EXPECT_EQ(darkness_in(stage.draw(), {{0, 0}, {320, 240}}).mean, 0);
  Renderer empty = must(Renderer::build(device(), 1));
  const Image image = must(draw_picture(device(), empty, stage.scene));
  EXPECT_EQ(darkness_in(image, {{0, 0}, {320, 240}}).mean, 0);
}

}  // namespace
}  // namespace geotherm::test
