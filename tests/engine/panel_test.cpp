// SPDX-License-Identifier: MIT
#include "engine/renderer.h"

#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr glm::vec4 kEverywhere(-1e6F, -1e6F, 1e6F, 1e6F);
const glm::vec2 kOpaque(0.5F / 4, 0.5F);  // in the font below

constexpr std::uint32_t colour(unsigned r, unsigned g, unsigned b, unsigned a = 255) {
  return r | g << 8U | b << 16U | a << 24U;
}
glm::vec3 rgb(unsigned r, unsigned g, unsigned b) { return glm::vec3(r, g, b) / 255.0F; }

/// Four texels: full, none, half, a quarter.
PanelFont four_texels() { return {4, 1, {255, 0, 128, 64}, 1}; }

/// One command with one rectangle that shows the font's image from `uv_min` to `uv_max`.
void add_rectangle(PanelDraw& panels, glm::vec2 min, glm::vec2 max, std::uint32_t ink,
                   glm::vec4 clip = kEverywhere, glm::vec2 uv_min = kOpaque,
                   glm::vec2 uv_max = kOpaque) {
  const auto offset = static_cast<std::int32_t>(panels.vertices.size());
  panels.commands.push_back({clip, static_cast<std::uint32_t>(panels.indices.size()), 6, offset});
  panels.vertices.insert(panels.vertices.end(), {{min, uv_min, ink},
                                                 {{max.x, min.y}, {uv_max.x, uv_min.y}, ink},
                                                 {max, uv_max, ink},
                                                 {{min.x, max.y}, {uv_min.x, uv_max.y}, ink}});
  panels.indices.insert(panels.indices.end(), {0, 1, 2, 0, 2, 3});
}

class Panels : public GpuTest {
 protected:
  /// White, with nothing to be seen.
  static Stage white(int samples = 1) {
    Stage stage(device(), plane_model(1, 1), samples);
    stage.scene.surface.visible = false;
    must(stage.renderer.set_panel_font(four_texels()));
    return stage;
  }
  static Image draw(Stage& stage, const PanelDraw& panels, glm::ivec2 corner = {0, 0}) {
    return stage.draw_into(glm::ivec2(kSmallPicture), corner, {}, &panels);
  }
  static void expect_rectangle(const Image& image, const Box& box, const glm::vec3& ink) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const bool inside = x >= box.min.x && x < box.max.x && y >= box.min.y && y < box.max.y;
        ASSERT_EQ(difference(colour_at(image, x, y), inside ? ink : glm::vec3(1)), 0)
            << x << " " << y;
      }
    }
  }
};

TEST_F(Panels, FillThePixelsTheyNameWithTheColourTheyName) {
  for (const int samples : {1, 4}) {
    Stage stage = white(samples);
    PanelDraw panels;
    add_rectangle(panels, {40, 30}, {100, 50}, colour(12, 34, 56));
    expect_rectangle(draw(stage, panels), {{40, 30}, {100, 50}}, rgb(12, 34, 56));
  }
}

TEST_F(Panels, AreCutToTheirClipRectangles) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {320, 240}, colour(0, 0, 255), {60, 40, 90, 200});
  expect_rectangle(draw(stage, panels), {{60, 40}, {90, 200}}, rgb(0, 0, 255));
}

TEST_F(Panels, MayReachBeyondTheTarget) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {-500, -500}, {20, 10}, colour(9, 8, 7), {-300, -20, 5000, 5000});
  add_rectangle(panels, {0, 0}, {320, 240}, colour(1, 1, 1), {320, 0, 400, 240});
  add_rectangle(panels, {0, 0}, {320, 240}, colour(1, 1, 1), {50, 50, 50, 50});
  add_rectangle(panels, {0, 0}, {320, 240}, colour(1, 1, 1), {80, 80, 20, 20});
  expect_rectangle(draw(stage, panels), {{0, 0}, {20, 10}}, rgb(9, 8, 7));
}

TEST_F(Panels, ShowTheFontWithItsCoverage) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {10, 10}, {14, 11}, colour(0, 0, 0), kEverywhere, {0, 0}, {1, 1});
  const Image image = draw(stage, panels);
  const double expected[] = {1, 0, 128 / 255.0, 64 / 255.0};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(darkness(image, 10 + i, 10), expected[i], 1 / 255.0) << i;
}

/// Dear ImGui draws thin lines as ramps of its image.
TEST_F(Panels, ShowWhatLiesBetweenTheFontsTexels) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {100, 10}, colour(0, 0, 0), kEverywhere, {0.125F, 0.5F},
                {0.375F, 0.5F});
  const Image image = draw(stage, panels);
  for (int x = 0; x < 100; ++x) {
    EXPECT_NEAR(darkness(image, x, 5), 1 - (x + 0.5) / 100, 2 / 255.0) << x;
  }
}

TEST_F(Panels, LetThroughWhatTheyDoNotCover) {
  Stage stage = white();
  stage.scene.background = {1, 1, 0, 1};
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {320, 240}, colour(0, 0, 255, 64));
  const float share = 64 / 255.0F;
  EXPECT_LE(difference(colour_at(draw(stage, panels), 160, 120), {1 - share, 1 - share, share}),
            1.0F / 255);
}

TEST_F(Panels, LieOverSceneAndOverlayTheLastOnTop) {
  Stage stage = full_stage(device());
  must(stage.renderer.set_panel_font(four_texels()));
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {320, 240}, colour(10, 20, 30));
  add_rectangle(panels, {20, 20}, {30, 40}, colour(40, 50, 60));
  const Image image = stage.draw_into(glm::ivec2(kSmallPicture), {0, 0}, some_text(), &panels);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool second = x >= 20 && x < 30 && y >= 20 && y < 40;
      ASSERT_EQ(colour_at(image, x, y), second ? rgb(40, 50, 60) : rgb(10, 20, 30));
    }
  }
}

TEST_F(Panels, StayWhereTheyAreWhereverThePictureLies) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {40, 30}, {100, 50}, colour(12, 34, 56));
  for (const glm::ivec2 corner : {glm::ivec2(90, 35), glm::ivec2(-70, -20), glm::ivec2(400, 0)}) {
    expect_rectangle(draw(stage, panels, corner), {{40, 30}, {100, 50}}, rgb(12, 34, 56));
  }
}

TEST_F(Panels, LeaveSceneAndOverlayBesideThemAsTheyWere) {
  Stage stage = full_stage(device());
  must(stage.renderer.set_panel_font(four_texels()));
  const Image bare = stage.draw(some_text());
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {100, 240}, colour(10, 20, 30));
  const Image with = stage.draw_into(glm::ivec2(kSmallPicture), {0, 0}, some_text(), &panels);
  for (int y = 0; y < bare.height; ++y) {
    for (int x = 100; x < bare.width; ++x) {
      ASSERT_EQ(colour_at(with, x, y), colour_at(bare, x, y)) << x << " " << y;
    }
  }
  EXPECT_EQ(stage.draw(some_text()).pixels, bare.pixels);  // and the next frame
}

TEST_F(Panels, ThatHaveNothingToDrawChangeNothing) {
  Stage stage = white();
  PanelDraw panels;
  for (const auto& clip : {kEverywhere, glm::vec4(0)}) {  // the first time without any command
    const Image image = draw(stage, panels);
    EXPECT_EQ(darkness_in(image, inner(image)).mean, 0);
    panels.commands.push_back({clip, 0, 0, 0});
  }
}

/// Indices have 16 bits; what goes beyond is reached through the commands' offsets.
TEST_F(Panels, MayHaveMoreVerticesThanAnIndexCounts) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {5, 5}, colour(1, 2, 3));
  (void)draw(stage, panels);  // a small buffer first
  while (panels.vertices.size() < 70000) add_rectangle(panels, {0, 0}, {0, 0}, colour(0, 0, 0));
  panels.commands.erase(panels.commands.begin(), panels.commands.end() - 1);
  add_rectangle(panels, {40, 30}, {100, 50}, colour(12, 34, 56));
  expect_rectangle(draw(stage, panels), {{40, 30}, {100, 50}}, rgb(12, 34, 56));
}

TEST_F(Panels, ShowANewFontWhenItsVersionIsNew) {
  Stage stage = white();
  PanelDraw panels;
  add_rectangle(panels, {0, 0}, {10, 10}, colour(0, 0, 0), kEverywhere, {0.5F, 0.5F}, {0.5F, 0.5F});
  must(stage.renderer.set_panel_font({1, 1, {255}, 2}));
  EXPECT_EQ(darkness(draw(stage, panels), 5, 5), 1);
  must(stage.renderer.set_panel_font({1, 1, {0}, 2}));
  EXPECT_EQ(darkness(draw(stage, panels), 5, 5), 1);
  must(stage.renderer.set_panel_font({2, 2, {51, 51, 51, 51}, 3}));
  EXPECT_NEAR(darkness(draw(stage, panels), 5, 5), 0.2, 0.5 / 255);
}

}  // namespace
}  // namespace geotherm::test
