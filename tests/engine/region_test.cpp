// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/scene/colours.h"
#include "engine/scene/region_margins.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr glm::vec3 kNoRegion(0.62F);
constexpr float kRegionRounding = 1.5F / 255;
using Places = std::vector<std::int32_t>;

glm::vec3 colour_of(int region) { return region_colour(static_cast<std::uint32_t>(region)); }

class Regions : public GpuTest {
 protected:
  /// `distances`: scene units; empty: not known. The line between regions is as good as none.
  static Stage stage_with(Model model, const Places& regions,
                          const std::vector<float>& distances = {}) {
    Stage stage(device(), std::move(model), 1);
    must(stage.renderer.set_regions(regions,
                                    region_margins(stage.model.geometry(), regions, distances)));
    stage.scene.surface.line_width = 0;
    must(stage.renderer.set_colours(region_table()));
    stage.scene.surface.paint = Paint::kRegions;
    return stage;
  }
  static bool is(const glm::vec3& colour, const glm::vec3& other) {
    return difference(colour, other) <= kRegionRounding;
  }
  /// Where the first colour ends on a row of pixels, in scene space; what is neither of both is
  /// counted as half.
  static float border(const Stage& stage, const Image& image, const glm::vec3& from,
                      const glm::vec3& to, int mixed_at_most) {
    const glm::vec3 a = stage.scene.camera.project(from);
    const glm::vec3 b = stage.scene.camera.project(to);
    const auto count = static_cast<int>(b.x - a.x);
    const glm::vec3 left = colour_at(image, a + glm::vec3(2, 0, 0));
    const glm::vec3 right = colour_at(image, b - glm::vec3(2, 0, 0));
    float sum = 0;
    int mixed = 0;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 c = colour_at(image, static_cast<int>(a.x) + i, static_cast<int>(a.y));
      const bool known = is(c, left) || is(c, right);
      mixed += known ? 0 : 1;
      sum += is(c, left) ? 1.0F : known ? 0.0F : 0.5F;
    }
    EXPECT_LE(mixed, mixed_at_most);
    return from.x + sum / static_cast<float>(count) * (to.x - from.x);
  }
};

TEST_F(Regions, HaveTheirColours) {
  Model model = square_model(0.1F, 0);
  Places regions(4, 0);
  for (int i = 1; i < 6; ++i) {
    Model next = square_model(0.1F, 0);
    for (glm::vec3& p : next.positions) p.x += 0.25F * static_cast<float>(i);
    append(model, next);
    regions.insert(regions.end(), 4, i < 5 ? i : -1);
  }
  Stage stage = stage_with(model, regions);
  const Image image = stage.draw();
  for (int i = 0; i < 6; ++i) {
    const glm::vec3 at = stage.scene.camera.project({0.25F * static_cast<float>(i), 0.02F, 0});
    EXPECT_TRUE(is(colour_at(image, at), i < 5 ? colour_of(i) : kNoRegion)) << i;
  }
}

TEST_F(Regions, MeetInSharpBordersHalfWayWhereNothingIsKnownOfDistances) {
  // Corners in order: (-h, -h), (h, -h), (h, h), (-h, h).
  Stage stage = stage_with(square_model(0.5F, 0), {3, 7, 7, 3});
  const Image image = stage.draw();
  for (const float y : {-0.4F, -0.1F, 0.2F, 0.4F}) {
    EXPECT_NEAR(border(stage, image, {-0.5F, y, 0}, {0.5F, y, 0}, 1), 0, 0.01F) << y;
  }
}

TEST_F(Regions, MeetWhereDistancesAlongAnEdgeAreEqual) {
  Stage stage = stage_with(square_model(0.5F, 0), {3, 7, 7, 3}, {0.4F, 0, 0, 0.4F});
  const Image image = stage.draw();
  // The edge is 1 long: 0.4 + x = 1 - x.
  EXPECT_NEAR(border(stage, image, {-0.5F, -0.495F, 0}, {0.5F, -0.495F, 0}, 1), -0.2F, 0.01F);
}

TEST_F(Regions, HaveALineBetweenThem) {
  Stage stage = stage_with(square_model(0.5F, 0), {3, 7, 7, 3});
  stage.scene.surface.line_width = 5;
  stage.scene.surface.line_colour = {1, 0, 1};
  const Image image = stage.draw();
  const glm::vec3 at = stage.scene.camera.project({0, 0.1F, 0});
  for (const float away : {-2.0F, 0.0F, 2.0F}) {
    EXPECT_TRUE(is(colour_at(image, at + glm::vec3(away, 0, 0)), {1, 0, 1})) << away;
  }
  EXPECT_TRUE(is(colour_at(image, at - glm::vec3(7, 0, 0)), colour_of(3)));
  EXPECT_TRUE(is(colour_at(image, at + glm::vec3(7, 0, 0)), colour_of(7)));
}

TEST_F(Regions, ThatTouchAGreyOneAreAsSharp) {
  Stage stage = stage_with(square_model(0.5F, 0), {3, -1, -1, 3});
  const Image image = stage.draw();
  EXPECT_NEAR(border(stage, image, {-0.5F, 0.1F, 0}, {0.5F, 0.1F, 0}, 1), 0, 0.01F);
  const glm::vec3 right = stage.scene.camera.project({0.4F, 0.1F, 0});
  EXPECT_TRUE(is(colour_at(image, right), kNoRegion));
}

/// Nearest of a few points in the plane: what is drawn against where each pixel belongs.
TEST_F(Regions, OfPointsInThePlaneAreTheirCells) {
  const std::vector<glm::vec3> sources = {
      {-0.5F, 0.3F, 0}, {0.1F, 0.1F, 0}, {0.5F, -0.35F, 0}, {-0.3F, -0.4F, 0}, {0.6F, 0.4F, 0}};
  const auto nearest = [&](const glm::vec3& p) {
    return static_cast<int>(std::min_element(sources.begin(), sources.end(),
                                             [&](const glm::vec3& a, const glm::vec3& b) {
                                               return glm::length(a - p) < glm::length(b - p);
                                             }) -
                            sources.begin());
  };
  Model model = irregular_plane_model(20);
  Places regions;
  for (const glm::vec3& p : model.positions) regions.push_back(nearest(p));
  const std::vector<float> distances = model.values([&](const glm::vec3& p) {
    return glm::length(p - sources[static_cast<std::size_t>(nearest(p))]);
  });
  Stage stage = stage_with(model, regions, distances);
  const Image image = stage.draw();
  const glm::ivec2 corner(stage.scene.camera.project({-0.8F, 0.6F, 0}));
  const glm::vec2 origin(stage.scene.camera.project({0, 0, 0}));
  const float pixels = stage.scene.camera.pixels_per_unit;
  int wrong = 0;
  int all = 0;
  for (int y = corner.y + 3; y < image.height - corner.y - 3; ++y) {
    for (int x = corner.x + 3; x < image.width - corner.x - 3; ++x, ++all) {
      const glm::vec2 away = (glm::vec2(x, y) + 0.5F - origin) / pixels;
      const int expected = nearest({away.x, -away.y, 0});
      wrong += is(colour_at(image, x, y), colour_of(expected)) ? 0 : 1;
    }
  }
  // Borders are some 500 pixels long here and one pixel wide; with cells decided by the nearest
  // corner alone they stray by a third of an edge, four pixels.
  constexpr double kBorders = 0.025;
  EXPECT_LE(static_cast<double>(wrong) / all, kBorders);
}

TEST_F(Regions, CarryIsolines) {
  Stage stage = stage_with(plane_model(4, 2), Places(15, 2));
  const Image bare = stage.draw();
  must(stage.renderer.set_values(stage.model.values([](const glm::vec3& p) { return p.x + 1; })));
  EXPECT_EQ(stage.draw().pixels, bare.pixels);
  stage.scene.surface.line_width = 1.4F;
  stage.scene.surface.line_spacing = 0.25F;
  EXPECT_GT(different_pixels(bare, stage.draw(), 50), 0.01);
}

TEST_F(Regions, AreGoneWithTheirModelAndOnRequest) {
  Stage stage = stage_with(square_model(0.5F, 0), {3, 7, 7, 3});
  const glm::vec3 at = stage.scene.camera.project({-0.3F, 0.1F, 0});
  stage.scene.surface.colour = glm::vec3(1);
  EXPECT_TRUE(is(colour_at(stage.draw(), at), colour_of(3)));
  must(stage.renderer.set_regions({}, {}));
  EXPECT_TRUE(is(colour_at(stage.draw(), at), glm::vec3(1)));
  must(stage.renderer.set_regions(Places{3, 7, 7, 3}, std::vector<float>(4, 1)));
  must(stage.renderer.set_surface(stage.model.geometry()));
  EXPECT_TRUE(is(colour_at(stage.draw(), at), glm::vec3(1)));
}

TEST_F(Regions, OfDegenerateTrianglesAreDrawn) {
  Model model = square_model(0.5F, 0);
  model.positions.push_back({0.5F, 0.5F, 0});
  model.faces.push_back({2, 4, 2});
  model.faces.push_back({0, 2, 4});
  const Image image = stage_with(model, {3, 7, 7, 3, 9}).draw();
  EXPECT_GT(different_pixels(image, Stage(device(), model).draw(), 2), 0.1);
}

}  // namespace
}  // namespace geotherm::test
