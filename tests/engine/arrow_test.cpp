// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/scene/arrows.h"
#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

/// One triangle about the origin: room for one large arrow.
Model one_triangle() { return {{{-0.8F, -0.5F, 0}, {0.8F, -0.5F, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

/// Pixels by colour, as places from the picture's middle (y up).
using Pixels = std::vector<glm::dvec2>;
Pixels pixels_where(const Image& image, const std::function<bool(const glm::vec3&)>& wanted) {
  Pixels pixels;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (wanted(colour_at(image, x, y))) {
        pixels.emplace_back(x + 0.5 - image.width / 2.0, image.height / 2.0 - y - 0.5);
      }
    }
  }
  return pixels;
}
bool is_black(const glm::vec3& c) { return c.r < 0.3F && c.g < 0.3F && c.b < 0.3F; }
bool is_blue(const glm::vec3& c) { return c.b > c.r + 0.3F; }

struct Extent {
  double min = 1e9, max = -1e9;
  double size() const { return max - min; }
};
Extent extent_along(const Pixels& pixels, const glm::dvec2& way) {
  Extent extent;
  for (const glm::dvec2& p : pixels) {
    extent.min = std::min(extent.min, glm::dot(p, way));
    extent.max = std::max(extent.max, glm::dot(p, way));
  }
  return extent;
}

glm::vec3 direction(double degrees) {
  return {std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)), 0};
}

class Arrows : public GpuTest {
 protected:
  static constexpr float kRoomForOne = 120;  ///< pixels; a single face is given one arrow

  static Stage stage_with(Model model) {
    Stage stage(device(), std::move(model));
    stage.scene.arrows.primary = stage.scene.arrows.secondary = true;
    if (stage.model.faces.size() == 1) stage.scene.arrows.spacing = kRoomForOne;
    return stage;
  }
};

class ArrowDirection : public Arrows, public testing::WithParamInterface<int> {};

TEST_P(ArrowDirection, IsThatOfItsVector) {
  Stage stage = stage_with(one_triangle());
  must(stage.renderer.set_arrows(std::vector{direction(GetParam())}, {}));
  const Pixels pixels = pixels_where(stage.draw(), is_black);
  ASSERT_GE(pixels.size(), 200U);
  const glm::dvec2 way(direction(GetParam()));
  const glm::dvec2 across(-way.y, way.x);
  const Extent along = extent_along(pixels, way);
  EXPECT_GT(along.size(), 2 * extent_along(pixels, across).size());
  // Its head, the widest part, lies beyond the middle, and it thins out towards the tip.
  std::map<int, Extent> widths;
  for (const glm::dvec2& p : pixels) {
    Extent& width = widths[static_cast<int>((glm::dot(p, way) - along.min) / along.size() * 9.99)];
    width.min = std::min(width.min, glm::dot(p, across));
    width.max = std::max(width.max, glm::dot(p, across));
  }
  const auto widest = std::max_element(widths.begin(), widths.end(), [](const auto& a, auto& b) {
    return a.second.size() < b.second.size();
  });
  EXPECT_GE(widest->first, 5);
  EXPECT_LE(widest->first, 7);
  EXPECT_GT(widest->second.size(), 2 * widths[2].size());
  EXPECT_LT(widths[9].size(), 0.5 * widest->second.size());
  // It is centred on the face.
  const glm::vec3 centre = stage.scene.camera.project({0, 0, 0});
  const glm::dvec2 middle(centre.x - kSmallPicture.x / 2, kSmallPicture.y / 2 - centre.y);
  EXPECT_NEAR((along.min + along.max) / 2, glm::dot(middle, way), 2);
}

INSTANTIATE_TEST_SUITE_P(All, ArrowDirection, testing::Range(0, 360, 45),
                         [](const auto& test) { return std::to_string(test.param); });

TEST_F(Arrows, AreNotDrawnForZeroVectors) {
  Stage stage = stage_with(plane_model(20, 15));
  const Image before = stage.draw();
  const std::vector<glm::vec3> zeros(stage.model.faces.size(), glm::vec3(0));
  must(stage.renderer.set_arrows(zeros, zeros));
  EXPECT_EQ(stage.draw().pixels, before.pixels);
}

TEST_F(Arrows, AreDrawnOnlyWhenTheirFieldIsWanted) {
  Stage stage = stage_with(one_triangle());
  must(stage.renderer.set_arrows(std::vector{direction(0)}, std::vector{direction(90)}));
  for (const bool primary : {false, true}) {
    for (const bool secondary : {false, true}) {
      stage.scene.arrows.primary = primary;
      stage.scene.arrows.secondary = secondary;
      const Image image = stage.draw();
      EXPECT_EQ(!pixels_where(image, is_black).empty(), primary);
      EXPECT_EQ(!pixels_where(image, is_blue).empty(), secondary);
    }
  }
}

TEST_F(Arrows, AreAsLongAsTheirVectors) {
  Stage stage = stage_with(one_triangle());
  const auto length = [&](float share) {
    must(stage.renderer.set_arrows({}, std::vector{share * direction(0)}));
    return extent_along(pixels_where(stage.draw(), is_blue), {1, 0}).size();
  };
  const double full = length(1);
  EXPECT_GT(full, 40);
  EXPECT_NEAR(length(0.5F), 0.5 * full, 2);
  EXPECT_NEAR(length(0.25F), 0.25 * full, 2);
}

TEST_F(Arrows, OfBothFieldsBeginAtTheSamePoint) {
  Stage stage = stage_with(one_triangle());
  must(stage.renderer.set_arrows(std::vector{direction(0)}, std::vector{direction(90)}));
  const Image image = stage.draw();
  const Pixels black = pixels_where(image, is_black);
  const Pixels blue = pixels_where(image, is_blue);
  const Extent blue_x = extent_along(blue, {1, 0});
  const Extent black_y = extent_along(black, {0, 1});
  EXPECT_NEAR((blue_x.min + blue_x.max) / 2, extent_along(black, {1, 0}).min, 3);
  EXPECT_NEAR((black_y.min + black_y.max) / 2, extent_along(blue, {0, 1}).min, 3);
}

TEST_F(Arrows, AreReplacedAlone) {
  Stage stage = stage_with(one_triangle());
  must(stage.renderer.set_arrows(std::vector{direction(0)}, {}));
  const Image first = stage.draw();
  must(stage.renderer.set_arrows(std::vector{direction(120)}, {}));
  EXPECT_NE(stage.draw().pixels, first.pixels);
  must(stage.renderer.set_arrows(std::vector{direction(0)}, {}));
  EXPECT_EQ(stage.draw().pixels, first.pixels);
}

/// How many arrows have their middle in the picture.
int count_seen(const std::vector<ArrowInstance>& arrows, const Camera& camera) {
  return static_cast<int>(std::ranges::count_if(arrows, [&](const ArrowInstance& arrow) {
    const glm::vec3 at = camera.project(arrow.tail + 0.5F * arrow.along);
    return at.x >= 0 && at.y >= 0 && at.x < camera.extent.x && at.y < camera.extent.y;
  }));
}

/// The arrows along +X that a view of a plane shows.
std::vector<ArrowInstance> chosen_on(const Model& model, const Camera& camera,
                                     const ArrowStyle& style) {
  const std::vector<glm::vec3> field(model.faces.size(), glm::vec3(1, 0, 0));
  const ArrowPlaces places(model.geometry());
  return select_arrows({model.geometry(), places}, camera, style, 1, field, {}).primary;
}

class ArrowDensity : public testing::TestWithParam<float> {};

TEST_P(ArrowDensity, FitsThePictureAtEveryZoom) {
  const Model model =
      model_of(transformed(plane_grid(160, 120, 1.6, 1.2), 1, {-0.8, -0.6, 0}, false));
  Orbit orbit = kFromFront;
  orbit.zoom = GetParam();
  const Camera camera = make_camera(orbit, model.positions, kSmallPicture);
  ArrowStyle style;
  style.primary = true;
  const auto chosen = chosen_on(model, camera, style);
  const int seen = count_seen(chosen, camera);
  for (const ArrowInstance& arrow : chosen) {
    EXPECT_NEAR(glm::length(arrow.along) * camera.pixels_per_unit, 0.92F * style.spacing, 0.1);
  }
  const float side = std::min(1.0F, GetParam());
  const double squares = 320.0 * 240.0 * side * side / (style.spacing * style.spacing);
  // Circles packed as closely as can be hold 1.15 a square, darts about 0.7; a level that is not
  // reached leaves half of that.
  EXPECT_LE(seen, 1.15 * squares);
  EXPECT_GE(seen, 0.25 * squares);
  // And only what may show is drawn.
  EXPECT_LE(chosen.size(), 5 * squares + 20);
}

INSTANTIATE_TEST_SUITE_P(All, ArrowDensity, testing::Values(0.5F, 1.0F, 1.5F, 2.0F, 3.0F),
                         [](const auto& test) { return std::to_string(test.index); });

class ArrowZoom : public testing::TestWithParam<float> {};

TEST_P(ArrowZoom, FillsLargeFacesWithArrowsOfReadableLength) {
  const Model model = plane_model(2, 2);
  Orbit orbit = kFromFront;
  orbit.zoom = GetParam();
  const Camera camera = make_camera(orbit, model.positions, kSmallPicture);
  ArrowStyle style;
  style.primary = true;
  const auto chosen = chosen_on(model, camera, style);
  for (const ArrowInstance& arrow : chosen) {
    EXPECT_LE(glm::length(arrow.along) * camera.pixels_per_unit, 2.1F * style.spacing);
  }
  EXPECT_GE(count_seen(chosen, camera), 15);
  EXPECT_LE(count_seen(chosen, camera), 200);
}

INSTANTIATE_TEST_SUITE_P(All, ArrowZoom, testing::Values(1.0F, 4.0F, 20.0F, 100.0F),
                         [](const auto& test) { return std::to_string(test.index); });

TEST(ArrowChoice, LeavesOutTheBacksOfSolids) {
  const Model model = model_of(sphere(4));
  const Camera camera = make_camera(kFromFront, model.positions, kSmallPicture);
  const std::vector<glm::vec3> field(model.faces.size(), glm::vec3(1, 0, 0));
  ArrowStyle style;
  style.primary = true;
  const ArrowPlaces places(model.geometry());
  for (const bool solid : {false, true}) {
    SurfaceGeometry geometry = model.geometry();
    geometry.solid = solid;
    int behind = 0;
    for (const auto& arrow :
         select_arrows({geometry, places}, camera, style, 1, field, {}).primary) {
      behind += arrow.tail.z < -0.1F;
    }
    EXPECT_EQ(behind == 0, solid);
  }
}

TEST(ArrowChoice, KeepsItsSpacingNearAndFar) {
  const Model model = plane_model(160, 120);
  const Camera camera = make_camera({.azimuth = 70, .elevation = 0, .field_of_view = 60},
                                    model.positions, {1280, 720});
  const std::vector<glm::vec3> field(model.faces.size(), glm::vec3(0, 1, 0));
  ArrowStyle style;
  style.primary = true;
  const ArrowPlaces places(model.geometry());
  const auto arrows =
      select_arrows({model.geometry(), places}, camera, style, 1, field, {}).primary;
  EXPECT_GE(arrows.size(), 100U);
  const auto middle = [](const ArrowInstance& a) { return a.tail + 0.5F * a.along; };
  const auto pixels_per_unit = [&](const glm::vec3& p) {
    return camera.pixels_per_unit / -(camera.view * glm::vec4(p, 1)).z;
  };
  float nearest = 0;
  float farthest = 1e9F;
  for (const ArrowInstance& a : arrows) {
    const glm::vec3 p = middle(a);
    nearest = std::max(nearest, pixels_per_unit(p));
    farthest = std::min(farthest, pixels_per_unit(p));
    for (const ArrowInstance& b : arrows) {
      if (&a == &b) continue;
      const glm::vec3 q = middle(b);
      const float larger = std::max(pixels_per_unit(p), pixels_per_unit(q));
      EXPECT_GE(glm::distance(p, q) * larger, 0.999F * style.spacing);
    }
  }
  EXPECT_GT(nearest, 1.5F * farthest);  // there is a near and a far
}

TEST(ArrowChoice, KeepsWhatIsThereWhileOneZoomsIn) {
  const Model model = plane_model(80, 60);
  const ArrowPlaces places(model.geometry());
  const std::vector<glm::vec3> field(model.faces.size(), glm::vec3(0, 0.01F, 0));
  ArrowStyle style;
  style.primary = true;
  const auto tails = [&](float zoom) {
    Orbit orbit = kFromFront;
    orbit.zoom = zoom;
    const Camera camera = make_camera(orbit, model.positions, {2000, 1500});
    std::vector<glm::vec3> all;
    for (const auto& arrow :
         select_arrows({model.geometry(), places}, camera, style, 4, field, {}).primary) {
      all.push_back(arrow.tail + 0.5F * arrow.along);
    }
    return all;
  };
  const auto far = tails(1);
  const auto near = tails(1.6F);
  EXPECT_GT(near.size(), far.size());
  int kept = 0;
  int inside = 0;
  for (const glm::vec3& p : far) {
    if (std::abs(p.x) > 0.45F || std::abs(p.y) > 0.35F) continue;  // out of the picture
    ++inside;
    kept += std::any_of(near.begin(), near.end(),
                        [&](const glm::vec3& q) { return glm::distance(p, q) < 1e-4F; });
  }
  EXPECT_GT(inside, 10);
  EXPECT_EQ(kept, inside);
}

}  // namespace
}  // namespace geotherm::test
