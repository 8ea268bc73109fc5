// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/engine/measure.h"
#include "tests/engine/stage.h"

namespace geotherm::test {
namespace {

using namespace geotherm::engine;

constexpr float kWidth = 5;
constexpr float kRimWidth = 2;
constexpr glm::vec3 kOrange(1, 0.5F, 0), kTeal(0, 0.3F, 0.3F), kRed(1, 0, 0), kBlue(0, 0, 1);
constexpr float kRounding = 1.5F / 255;
using Points = std::vector<glm::vec3>;

class Lines : public GpuTest {
 protected:
  /// On white; black lines, whose rim is as white as the surface.
  static Stage stage_with(Model model, const Points& points, int samples = 1) {
    Stage stage(device(), std::move(model), samples);
    stage.scene.surface.colour = glm::vec3(1);
    stage.scene.lines.width = kWidth;
    stage.scene.lines.rim = kRimWidth;
    stage.scene.lines.hidden_opacity = 0;  // but for the tests about that
    set(stage, points);
    return stage;
  }
  static void set(Stage& stage, const Points& points, const glm::vec3& colour = glm::vec3(0)) {
    const Polyline line{points, colour};
    must(stage.renderer.set_lines({&line, 1}));
  }
  static double covered(const Image& image) {
    const Box all = inner(image);
    return darkness_in(image, all).mean * all.area();
  }
  static glm::vec2 on_screen(const Stage& stage, const glm::vec3& point) {
    return glm::vec2(stage.scene.camera.project(point));
  }
  static void expect_colour(const Image& image, const glm::vec2& at, const glm::vec3& expected) {
    EXPECT_LE(difference(colour_at(image, glm::vec3(at, 0)), expected), kRounding)
        << at.x << " " << at.y;
  }
};

/// Direction in the plane (degrees), zoom, perspective.
class LineWidth : public Lines,
                  public testing::WithParamInterface<std::tuple<float, float, bool>> {};

TEST_P(LineWidth, IsTheSameOnScreen) {
  const auto [degrees, zoom, perspective] = GetParam();
  constexpr double kSampling = 0.03;  // rows meet an edge at few distances from pixels
  const float angle = glm::radians(degrees);
  const glm::vec3 way(std::cos(angle), std::sin(angle), 0);
  for (const float scale : {1.0F, 1.5F}) {
    Stage stage = stage_with(plane_model(2, 2), {-0.4F * way, 0.4F * way});
    Orbit orbit = kFromFront;
    orbit.zoom = zoom;
    orbit.orthographic = !perspective;
    stage.look(orbit);
    stage.scene.pixel_scale = scale;
    const Image image = stage.draw();
    double width = 0;
    int rows = 0;
    for (int y = 110; y < 130; ++y, ++rows) {
      const auto runs = dark_runs(image, {40, y}, {1, 0}, image.width - 80);
      ASSERT_EQ(runs.size(), 1U);
      width += runs[0].darkness * std::sin(angle);
    }
    EXPECT_NEAR(width / rows / (kWidth * scale), 1, kSampling);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LineWidth,
                         testing::Values(std::tuple(90.0F, 1.0F, false),
                                         std::tuple(60.0F, 1.0F, true),
                                         std::tuple(45.0F, 1.0F, false),
                                         std::tuple(70.0F, 4.0F, true)),
                         [](const auto& test) { return std::to_string(test.index); });

TEST_F(Lines, HaveTheirColourAndARimThatStandsOutFromIt) {
  for (const glm::vec3& colour : {kOrange, kTeal}) {
    Stage stage = stage_with(plane_model(2, 2), {});
    stage.scene.surface.colour = glm::vec3(0.5F);
    stage.scene.lines.dark_rim = kBlue;
    stage.scene.lines.light_rim = glm::vec3(1);
    set(stage, {{-0.4F, 0.1F, 0}, {0.4F, 0.1F, 0}}, colour);
    const Image image = stage.draw();
    const glm::vec2 middle = on_screen(stage, {0, 0.1F, 0});
    expect_colour(image, middle, colour);
    for (const float side : {-1.0F, 1.0F}) {
      const glm::vec2 out(0, side);
      expect_colour(image, middle + out * (0.5F * kWidth + 0.5F * kRimWidth),
                    colour == kOrange ? kBlue : glm::vec3(1));
      expect_colour(image, middle + out * (0.5F * kWidth + kRimWidth + 1.5F), glm::vec3(0.5F));
    }
  }
}

class LineSamples : public Lines, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(All, LineSamples, testing::Values(1, 4),
                         [](const auto& test) { return std::to_string(test.param); });

TEST_P(LineSamples, AreRoundAtTheirEndsAndJoints) {
  const Points corner = {{-0.3F, -0.2F, 0}, {0.1F, 0.3F, 0}, {0.3F, -0.1F, 0}, {-0.1F, -0.1F, 0}};
  Stage stage = stage_with(plane_model(2, 2), corner, GetParam());
  stage.scene.lines.width = 20;
  const Image image = stage.draw();
  for (std::size_t i = 1; i < corner.size(); ++i) {
    for (float t = 0; t <= 1; t += 0.02F) {
      expect_colour(image, on_screen(stage, glm::mix(corner[i - 1], corner[i], t)), glm::vec3(0));
    }
  }
  for (const glm::vec3& point : corner) {
    for (int i = 0; i < 32; ++i) {
      const double a = i * std::numbers::pi / 16;
      const glm::vec2 way(std::cos(a), std::sin(a));
      expect_colour(image, on_screen(stage, point) + 8.5F * way, glm::vec3(0));
    }
  }
  const glm::vec2 first = on_screen(stage, corner[0]) - on_screen(stage, corner[1]);
  expect_colour(image, on_screen(stage, corner[0]) + 12.5F * glm::normalize(first), glm::vec3(1));
}

/// Neighbours share each pixel between them: what both covered would be darker at the edges.
TEST_P(LineSamples, OfManyPointsLookLikeThoseOfFew) {
  const Points ends = {{-0.61F, -0.33F, 0}, {0.57F, 0.41F, 0}};
  Points many;
  for (int i = 0; i <= 2000; ++i) {
    many.push_back(glm::mix(ends[0], ends[1], static_cast<float>(i) / 2000));
  }
  Stage stage = stage_with(plane_model(2, 2), ends, GetParam());
  const Image few = stage.draw();
  set(stage, many);
  // Ends of single precision: a pixel here and there.
  constexpr double kRoundingPixels = 0.0002;
  EXPECT_LE(different_pixels(few, stage.draw(), 3), kRoundingPixels);
}

TEST_P(LineSamples, ThatBendAreAsWideAsThoseThatDoNot) {
  constexpr float kRadius = 0.4F;
  for (const int count : {12, 60, 2000}) {
    Points circle;
    for (int i = 0; i <= count; ++i) {
      const double a = 2 * std::numbers::pi * i / count;
      circle.emplace_back(kRadius * std::cos(a), kRadius * std::sin(a), 0);
    }
    Stage stage = stage_with(plane_model(2, 2), circle, GetParam());
    const double half_turn = std::numbers::pi / count;
    const double length = 2 * count * std::sin(half_turn) * kRadius;
    const double pixels = length * stage.scene.camera.pixels_per_unit;
    EXPECT_NEAR(covered(stage.draw()) / (pixels * kWidth), 1, 0.01) << count;
  }
}

TEST_F(Lines, AreHiddenBehindTheSurface) {
  Model model = square_model(0.3F, 0.3F);
  append(model, square_model(0.6F, -0.3F));
  Stage stage = stage_with(model, {{-0.5F, 0, -0.3F}, {0.5F, 0, -0.3F}});
  const Image image = stage.draw();
  for (const float x : {-0.4F, 0.4F}) {
    expect_colour(image, on_screen(stage, {x, 0, -0.3F}), glm::vec3(0));
  }
  for (float x = -0.27F; x < 0.28F; x += 0.03F) {
    expect_colour(image, on_screen(stage, {x, 0, 0}), glm::vec3(1));
  }
}

TEST_F(Lines, AreDashedWhereTheSurfaceHidesThem) {
  Model model = square_model(0.45F, 0.3F);
  append(model, square_model(0.6F, -0.3F));
  Stage stage = stage_with(model, {{-0.6F, 0, -0.3F}, {0.6F, 0, -0.3F}});
  stage.scene.lines.hidden_opacity = 0.5F;
  stage.scene.lines.hidden_width = 0.6F;
  stage.scene.lines.dash = 20;
  stage.scene.lines.rim = 0;
  const Image image = stage.draw();
  const glm::ivec2 from(on_screen(stage, {-0.44F, 0, 0})), to(on_screen(stage, {0.44F, 0, 0}));
  const auto runs = dark_runs(image, from, {1, 0}, to.x - from.x);
  ASSERT_NEAR(static_cast<double>(runs.size()), (to.x - from.x) / 20.0, 1.5);  // cut at both ends
  for (std::size_t i = 1; i + 1 < runs.size(); ++i) {
    EXPECT_NEAR(runs[i].darkness, 0.5 * 0.6 * 20, 1);  // half opaque, three fifths of the way
  }
  double across = 0;
  const int x = static_cast<int>(from.x + (to.x - from.x) / 2);
  for (int i = -15; i < 15; ++i) {
    const auto column = dark_runs(image, {x + i, from.y - 10}, {0, 1}, 20);
    if (!column.empty()) across = std::max(across, static_cast<double>(column[0].darkness));
  }
  EXPECT_NEAR(across, 0.5 * 0.6 * kWidth, 0.15);
}

TEST_F(Lines, OnTheFarSideOfASphereAreNotSeen) {
  Stage stage = stage_with(model_of(sphere(4)), {});
  const Image bare = stage.draw();
  Points arc;
  for (int i = 0; i <= 50; ++i) {
    const double a = std::numbers::pi * (0.1 + 0.8 * i / 50);
    arc.emplace_back(std::cos(a), 0, -std::sin(a));
  }
  set(stage, arc);
  EXPECT_EQ(stage.draw().pixels, bare.pixels);
}

TEST_F(Lines, AreSeenFromBothSidesOfAnOpenSurface) {
  for (const float azimuth : {0.0F, 180.0F}) {
    Stage stage = stage_with(plane_model(3, 2), {{-0.5F, 0.05F, 0}, {0.5F, 0.05F, 0}});
    stage.look({.azimuth = azimuth, .elevation = 0});
    const Image image = stage.draw();
    for (float x = -0.5F; x <= 0.5F; x += 0.05F) {
      expect_colour(image, on_screen(stage, {x, 0.05F, 0}), glm::vec3(0));
    }
  }
}

/// A surface that is seen under this angle (degrees; 90: straight), in perspective or without.
class LineOnInclined : public Lines, public testing::WithParamInterface<std::pair<float, bool>> {};

TEST_P(LineOnInclined, IsSeenWhole) {
  const auto [angle, orthographic] = GetParam();
  const Points across = {{-0.3F, -0.5F, 0}, {0.3F, 0.5F, 0}};
  Stage with = stage_with(plane_model(2, 2), across, 4);
  with.look({.azimuth = 90 - angle, .elevation = 0, .orthographic = orthographic});
  const double on_surface = covered(with.draw());
  const glm::vec2 ends = on_screen(with, across[1]) - on_screen(with, across[0]);
  const double free = glm::length(ends) * kWidth + std::numbers::pi * kWidth * kWidth / 4;
  EXPECT_NEAR(on_surface / free, 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(All, LineOnInclined,
                         testing::Values(std::pair(60.0F, false), std::pair(60.0F, true),
                                         std::pair(30.0F, false), std::pair(30.0F, true)),
                         [](const auto& test) {
                           return std::to_string(static_cast<int>(test.param.first)) +
                                  (test.param.second ? "Orthographic" : "Perspective");
                         });

TEST_F(Lines, ThatComeLaterLieOverEarlierOnes) {
  const Points flat = {{-0.4F, 0, 0}, {0.4F, 0, 0}};
  const Points steep = {{0, -0.4F, 0}, {0, 0.4F, 0}};
  Stage stage = stage_with(plane_model(2, 2), {});
  for (const bool flat_first : {true, false}) {
    const Polyline a{flat, kRed};
    const Polyline b{steep, kBlue};
    must(stage.renderer.set_lines(flat_first ? std::array{a, b} : std::array{b, a}));
    const Image image = stage.draw();
    expect_colour(image, on_screen(stage, {0, 0, 0}), flat_first ? kBlue : kRed);
    expect_colour(image, on_screen(stage, {0.2F, 0, 0}), kRed);
    expect_colour(image, on_screen(stage, {0, 0.2F, 0}), kBlue);
  }
}

TEST_F(Lines, LieUnderTheSources) {
  Stage stage = stage_with(plane_model(2, 2), {{-0.4F, 0, 0}, {0.4F, 0, 0}});
  stage.scene.markers.colour = kOrange;
  const Marker marker{{0.4F, 0, 0}, {0.4F, 0, 0}};
  must(stage.renderer.set_markers({&marker, 1}));
  expect_colour(stage.draw(), on_screen(stage, {0.4F, 0, 0}), kOrange);
}

TEST_F(Lines, ThatPassTheEyeAreCutThere) {
  Stage stage = stage_with(plane_model(2, 2), {});
  stage.look({.azimuth = 0, .elevation = 0, .zoom = 4});
  const Image bare = stage.draw();
  set(stage, {{0, 0, 20}, {0.2F, 0, 30}});
  EXPECT_EQ(stage.draw().pixels, bare.pixels);
  set(stage, {{0.02F, 0.02F, 0}, {0.02F, 0.02F, 100}, {-50, 3, 200}});
  EXPECT_GT(covered(stage.draw()), 0);
}

TEST_F(Lines, ThatAreNoneDrawNothing) {
  Stage stage = stage_with(plane_model(2, 2), {});
  const Image bare = stage.draw();
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const Points& points : {Points{{0.1F, 0.1F, 0}}, Points{{0.1F, 0.1F, 0}, {0.1F, 0.1F, 0}},
                               Points{{none, 0, 0}, {0.1F, 0.1F, 0}, {0, none, 0}}}) {
    set(stage, points);
    EXPECT_EQ(stage.draw().pixels, bare.pixels);
  }
  set(stage, {{0, 0, 0}, {0.3F, 0, 0}});
  EXPECT_NE(stage.draw().pixels, bare.pixels);
  must(stage.renderer.set_lines({}));
  EXPECT_EQ(stage.draw().pixels, bare.pixels);
}

TEST_F(Lines, AreGoneWithTheirModelAndOnRequest) {
  Stage stage = stage_with(plane_model(2, 2), {{0, 0, 0}, {0.3F, 0, 0}});
  stage.scene.lines.visible = false;
  EXPECT_EQ(covered(stage.draw()), 0);
  stage.scene.lines.visible = true;
  EXPECT_GT(covered(stage.draw()), 0);
  must(stage.renderer.set_surface(stage.model.geometry()));
  EXPECT_EQ(covered(stage.draw()), 0);
}

}  // namespace
}  // namespace geotherm::test
