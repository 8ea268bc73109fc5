// SPDX-License-Identifier: MIT
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

// Pictures that take a part of their target, as in a window whose panels take the rest.
namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// Share of pixels that may differ by more than 1/255. Positions are rounded to other floats; from
/// odd corners lines are measured over other pairs of pixels as well.
constexpr double kPlaceRounding = 0.005;
constexpr double kOtherPairs = 0.03;
double tolerance(glm::ivec2 corner) {
  return (corner.x | corner.y) % 2 == 0 ? kPlaceRounding : kOtherPairs;
}

Image part_of(const Image& image, glm::ivec2 from, glm::ivec2 size) {
  Image part;
  part.width = size.x;
  part.height = size.y;
  for (int y = 0; y < size.y; ++y) {
    const std::uint8_t* const row = image.at(from.x, from.y + y);
    part.pixels.insert(part.pixels.end(), row, row + 4 * size.x);
  }
  return part;
}

class PicturePlace : public GpuTest, public testing::WithParamInterface<glm::ivec2> {};

TEST_P(PicturePlace, ShowsThePictureAsAlone) {
  for (const int samples : {1, 4}) {
    Stage stage = full_stage(device(), samples);
    const Image alone = stage.draw(some_text());
    const Image placed = stage.draw_into({500, 400}, GetParam(), some_text());
    const Image part = part_of(placed, GetParam(), glm::ivec2(kSmallPicture));
    EXPECT_LE(different_pixels(part, alone, 1), tolerance(GetParam())) << samples;
  }
}

TEST_P(PicturePlace, ShowsNothingButBackgroundBesideIt) {
  const glm::vec3 paper(0.2F, 0.4F, 0.6F);
  const glm::ivec2 size(500, 400);
  const glm::ivec2 end = GetParam() + glm::ivec2(kSmallPicture);
  for (const int samples : {1, 4}) {
    Stage stage = full_stage(device(), samples);
    stage.look({.zoom = 5});  // much larger than the picture
    stage.scene.background = glm::vec4(paper, 1);
    Overlay overlay;
    overlay.add_rectangle({-1000, -1000}, {1000, 1000}, {1, 0, 0, 1});
    const Image placed = stage.draw_into(size, GetParam(), overlay);
    // With several samples software devices let some of the next pixels' through.
    const int margin = samples == 1 ? 0 : 1;
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const glm::ivec2 beyond =
            glm::max(GetParam() - glm::ivec2(x, y), glm::ivec2(x, y) - end + 1);
        const int distance = std::max(beyond.x, beyond.y);  // 0 and less: inside
        if (distance > 0 && distance <= margin) continue;
        ASSERT_LE(difference(colour_at(placed, x, y), distance > 0 ? paper : glm::vec3(1, 0, 0)),
                  1.0F / 255)
            << samples << ": " << x << " " << y;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PicturePlace,
                         testing::Values(glm::ivec2(0, 0), glm::ivec2(100, 80), glm::ivec2(101, 33),
                                         glm::ivec2(0, 160)),
                         [](const auto& test) {
                           return std::to_string(test.param.x) + "_" + std::to_string(test.param.y);
                         });

class PictureCut : public GpuTest {};

TEST_F(PictureCut, ByItsTargetShowsThePartThatIsThere) {
  Stage stage = full_stage(device());
  const Image alone = stage.draw(some_text());
  const Image cut = stage.draw_into({200, 100}, {60, 40}, some_text());
  const glm::ivec2 size(140, 60);
  EXPECT_LE(different_pixels(part_of(cut, {60, 40}, size), part_of(alone, {0, 0}, size), 1),
            kPlaceRounding);
}

TEST_F(PictureCut, OutsideOfItsTargetShowsTheBackground) {
  Stage stage = full_stage(device());
  for (const glm::ivec2 corner : {glm::ivec2(200, 0), glm::ivec2(-320, 0), glm::ivec2(0, 5000)}) {
    const Image nothing = stage.draw_into({200, 100}, corner, some_text());
    EXPECT_EQ(darkness_in(nothing, inner(nothing)).mean, 0);
  }
}

}  // namespace
}  // namespace geotherm::test
