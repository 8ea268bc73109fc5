// SPDX-License-Identifier: MIT
#include "engine/overlay/overlay.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

const glm::vec4 kInkBlue(0.2F, 0.4F, 0.8F, 1);

class OverlayDrawing : public GpuTest {};

TEST_F(OverlayDrawing, FillsExactlyItsRectangle) {
  for (const int samples : {1, 4}) {
    Stage stage(device(), plane_model(1, 1), samples);
    stage.scene.surface.colour = glm::vec3(1);
    Overlay overlay;
    overlay.add_rectangle({40, 30}, {100, 50}, kInkBlue);
    const Image image = stage.draw(overlay);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const bool inside = x >= 40 && x < 100 && y >= 30 && y < 50;
        ASSERT_LE(difference(colour_at(image, x, y), inside ? glm::vec3(kInkBlue) : glm::vec3(1)),
                  1.0F / 255)
            << x << " " << y;
      }
    }
  }
}

TEST_F(OverlayDrawing, RunsFromTheUpperToTheLowerColour) {
  Stage stage(device(), plane_model(1, 1));
  Overlay overlay;
  overlay.add_gradient({10, 20}, {50, 120}, {1, 0, 0, 1}, {0, 0, 1, 1});
  const Image image = stage.draw(overlay);
  for (int y = 20; y < 120; ++y) {
    const float at = (static_cast<float>(y - 20) + 0.5F) / 100;
    EXPECT_LE(difference(colour_at(image, 30, y), {1 - at, 0, at}), 1.5F / 255) << y;
  }
}

TEST_F(OverlayDrawing, LetsThroughWhatItDoesNotCover) {
  Stage stage(device(), plane_model(1, 1));
  stage.scene.surface.colour = {1, 1, 0};
  Overlay overlay;
  overlay.add_rectangle({0, 0}, {320, 240}, {0, 0, 1, 0.25F});
  EXPECT_LE(difference(colour_at(stage.draw(overlay), 160, 120), {0.75F, 0.75F, 0.25F}),
            1.5F / 255);
}

TEST_F(OverlayDrawing, WritesTextWhereItsGlyphsAre) {
  Stage stage(device(), plane_model(1, 1));
  stage.scene.surface.colour = glm::vec3(1);
  const std::string text = "Heat 0.25";
  Overlay overlay;
  overlay.atlas = GlyphAtlas::build(24, {text});
  const glm::vec2 base(60, 100);
  overlay.add_text(base, text, {0, 0, 0, 1});
  const Image image = stage.draw(overlay);
  // As dark in all as the glyphs' coverage, and nowhere else.
  double expected = 0;
  for (const char letter : text) {
    const auto& glyph = overlay.atlas.glyph(static_cast<unsigned char>(letter));
    const glm::vec2 size(overlay.atlas.width(), overlay.atlas.height());
    const glm::ivec2 min(glm::round(glyph.uv_min * size));
    const glm::ivec2 max(glm::round(glyph.uv_max * size));
    for (int y = min.y; y < max.y; ++y) {
      for (int x = min.x; x < max.x; ++x) {
        expected += overlay.atlas.pixels()[static_cast<std::size_t>(y * overlay.atlas.width() + x)];
      }
    }
  }
  expected /= 255;
  ASSERT_GT(expected, 100);
  EXPECT_NEAR(darkness_in(image, inner(image)).mean * image.width * image.height, expected,
              0.01 * expected);
  const Box text_box{{58, 70}, {62 + static_cast<int>(overlay.atlas.width_of(text)), 110}};
  EXPECT_NEAR(darkness_in(image, text_box).mean * text_box.area(), expected, 0.01 * expected);
}

TEST_F(OverlayDrawing, IsOpaqueOverATransparentBackground) {
  Stage stage(device(), square_model(0.2F, 0));
  stage.look({.azimuth = 0, .elevation = 0, .zoom = 0.3F});
  stage.scene.background = {1, 1, 1, 0};
  Overlay overlay;
  overlay.add_rectangle({0, 0}, {20, 20}, kInkBlue);
  overlay.add_rectangle({0, 40}, {20, 60}, {0.2F, 0.4F, 0.8F, 0.5F});
  const Image image = stage.draw(overlay);
  EXPECT_EQ(image.at(10, 10)[3], 255);
  EXPECT_LE(difference(colour_at(image, 10, 10), kInkBlue), 1.0F / 255);
  EXPECT_NEAR(image.at(10, 50)[3], 127.5, 1);
  EXPECT_LE(difference(colour_at(image, 10, 50), kInkBlue), 2.5F / 255);  // not multiplied in
  EXPECT_EQ(image.at(10, 30)[3], 0);
}

TEST_F(OverlayDrawing, ChangesWithItsAtlas) {
  Stage stage(device(), plane_model(1, 1));
  stage.scene.surface.colour = glm::vec3(1);
  const auto with_text = [&](float height) {
    Overlay overlay;
    overlay.atlas = GlyphAtlas::build(height, {"abc"});
    overlay.add_text({50, 100}, "abc", {0, 0, 0, 1});
    return stage.draw(overlay);
  };
  const Image small = with_text(12);
  const Image large = with_text(40);
  EXPECT_GT(darkness_in(large, inner(large)).mean, 4 * darkness_in(small, inner(small)).mean);
  EXPECT_EQ(with_text(12).pixels, small.pixels);
  EXPECT_EQ(darkness_in(stage.draw(), inner(small)).mean, 0);
}

TEST_F(OverlayDrawing, ShowsALegendInTheRoomThatTheCameraLeaves) {
  Stage stage(device(), model_of(sphere(3)));
  stage.scene.surface.colour = glm::vec3(0);
  Legend legend;
  legend.bar = true;
  legend.colours = {{1, 0, 0}, {1, 0, 0}};
  legend.ticks = {{0, "0"}, {1, "1"}};
  const LegendLayout layout = lay_out(legend, kSmallPicture);
  ASSERT_GT(layout.insets.right, 0);
  stage.scene.camera = make_camera(kFromFront, stage.model.positions, kSmallPicture, layout.insets);
  const Image bare = stage.draw();
  const Image with = stage.draw(layout.overlay);
  const int from = bare.width - static_cast<int>(layout.insets.right);
  EXPECT_EQ(darkness_in(bare, {{from, 0}, {bare.width, bare.height}}).mean, 0);
  EXPECT_GT(darkness_in(with, {{from, 0}, {bare.width, bare.height}}).mean, 0);
  for (int y = 0; y < bare.height; ++y) {
    for (int x = 0; x < from; ++x) ASSERT_EQ(with.at(x, y)[0], bare.at(x, y)[0]);
  }
}

}  // namespace
}  // namespace geotherm::test
