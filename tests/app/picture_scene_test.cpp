// SPDX-License-Identifier: MIT
#include "app/drawing/picture_scene.h"
#include "app/drawing/picture_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/scene/colours.h"

namespace geotherm::test {
namespace {

using app::PictureData;
using app::PictureScale;
using app::PictureSettings;
using app::View;

constexpr float kFloatRounding = 1e-6F;

/// Distances 0 to 8 in model units, drawn as 0 to 1.
PictureData solved() {
  PictureData data;
  app::add_distances(data, std::vector<double>{0, 8});
  data.caption = "cap";
  return data;
}

engine::Scene scene_of(View view) {
  PictureSettings settings;
  settings.view = view;
  const PictureData data = solved();
  return app::scene_of(data, settings, app::picture_scale(data, settings));
}

engine::Legend legend_of(const PictureSettings& settings) {
  const PictureData data = solved();
  return app::legend_of(data, settings, app::picture_scale(data, settings));
}

TEST(PictureSceneOfView, ShowsWhatTheViewIsCalled) {
  EXPECT_TRUE(scene_of(View::kWireframe).surface.wire);
  EXPECT_FALSE(scene_of(View::kFlat).surface.smooth);
  EXPECT_TRUE(scene_of(View::kSmooth).surface.smooth);
  EXPECT_FALSE(scene_of(View::kSmooth).markers.visible);
  EXPECT_TRUE(scene_of(View::kSources).markers.visible);
  EXPECT_TRUE(scene_of(View::kHeatGradient).arrows.primary);
  EXPECT_FALSE(scene_of(View::kHeatGradient).arrows.secondary);
  EXPECT_TRUE(scene_of(View::kGradientError).arrows.primary);
  EXPECT_TRUE(scene_of(View::kGradientError).arrows.secondary);
  for (const View view : {View::kWireframe, View::kFlat, View::kSmooth, View::kSources,
                          View::kHeatGradient, View::kGradientError}) {
    EXPECT_EQ(scene_of(view).surface.paint, engine::Paint::kPlain);
    EXPECT_EQ(scene_of(view).surface.line_spacing, 0);
  }
  EXPECT_EQ(scene_of(View::kContours).surface.paint, engine::Paint::kMap);
}

TEST(PictureSceneOfView, PaintsErrorsByTheMapAndRegionsWhereTheyAreKnown) {
  EXPECT_EQ(scene_of(View::kExactError).surface.paint, engine::Paint::kMap);
  EXPECT_EQ(scene_of(View::kRegions).surface.paint, engine::Paint::kPlain);
  PictureData data = solved();
  data.nearest = {0, kNoIndex};
  PictureSettings settings;
  settings.view = View::kRegions;
  const auto style = app::scene_of(data, settings, app::picture_scale(data, settings)).surface;
  EXPECT_EQ(style.paint, engine::Paint::kRegions);
  EXPECT_GT(style.line_spacing, 0);
  settings.bands = 5;
  const auto banded = app::picture_scale(data, settings);
  EXPECT_EQ(app::scene_of(data, settings, banded).surface.line_spacing, style.line_spacing)
      << "each region has a colour of its own";
  EXPECT_TRUE(scene_of(View::kRegions).markers.visible);
  EXPECT_TRUE(scene_of(View::kExactError).markers.visible);
}

TEST(PictureSceneOfView, PaintsFacesByScalesOfTheirOwn) {
  PictureData data = solved();
  PictureSettings settings;
  settings.view = View::kNonDelaunay;
  settings.range_max = 0.5;  // of distances
  data.face_values = {0, 2};
  data.face_view = settings.view;
  data.face_title = "edges";
  data.largest_face_value = 3;
  const auto scale = app::picture_scale(data, settings);
  const auto scene = app::scene_of(data, settings, scale);
  EXPECT_EQ(scene.surface.paint, engine::Paint::kFaces);
  EXPECT_EQ(scene.surface.range_max, 3);
  EXPECT_EQ(scene.surface.line_spacing, 0);
  EXPECT_FALSE(scene.markers.visible) << "the mesh has no sources";
  const engine::Legend legend = app::legend_of(data, settings, scale);
  EXPECT_EQ(legend.title, "edges");
  ASSERT_EQ(legend.ticks.size(), 4U);
  EXPECT_EQ(legend.ticks[3].label, "3");
  EXPECT_EQ(legend.ticks[3].position, 1);
  for (const int bands : {2, 3, 4, 5, 7, 8, 9, 16, 64}) {
    settings.bands = bands;
    const auto banded = app::picture_scale(data, settings);
    EXPECT_EQ(app::scene_of(data, settings, banded).surface.range_max, float(banded.max));
    EXPECT_GE(banded.max, 3) << bands;
    const double in_one = (bands == 2 ? 2 : 1) * bands / banded.max;
    EXPECT_NEAR(in_one, std::round(in_one), 1e-9) << bands << ": borders at whole numbers";
  }
}

/// What is 0 is neutral, and errors of both signs look equally large.
TEST(PictureSceneOfView, ShowsNoErrorWithoutColourAndBothSignsAlike) {
  PictureData data;
  app::add_error(data, std::vector<double>{-3, 0, 2}, "error of d");
  PictureSettings settings;
  settings.view = View::kExactError;
  for (const char* name : {"red-blue", "cool-warm"}) {
    settings.colour_map = name;
    const auto scale = app::picture_scale(data, settings);
    const engine::Legend legend = app::legend_of(data, settings, scale);
    EXPECT_EQ(legend.title, "error of d");
    EXPECT_EQ(legend.ticks[legend.ticks.size() / 2].label, "0");
    EXPECT_NEAR(legend.ticks[legend.ticks.size() / 2].position, 0.5F, kFloatRounding);
    const auto& colours = legend.colours;
    const glm::vec3 zero = engine::oklab_of(colours[colours.size() / 2]);
    constexpr float kNeutral = 0.01F;  // of OKLab: not to be told from grey
    EXPECT_LE(std::hypot(zero.y, zero.z), kNeutral);
    constexpr float kAlike = 0.02F;
    for (std::size_t i = 0; i < colours.size() / 2; i += 64) {
      const float below = engine::oklab_of(colours[i]).x;
      const float above = engine::oklab_of(colours[colours.size() - 1 - i]).x;
      EXPECT_NEAR(below, above, kAlike) << i;
    }
  }
}

TEST(PictureSceneOfView, TakesRangeAndSpacingInModelUnits) {
  PictureSettings settings;
  settings.range_min = 2;
  settings.range_max = 16;
  settings.line_spacing = 4;
  const PictureData data = solved();
  const auto style = app::scene_of(data, settings, app::picture_scale(data, settings)).surface;
  EXPECT_EQ(style.range_min, 0.25F);
  EXPECT_EQ(style.range_max, 2);
  EXPECT_EQ(style.line_spacing, 0.5F);
}

TEST(PictureSceneOfView, HidesMarkersOnRequest) {
  PictureSettings settings;
  settings.markers = false;
  const PictureData data = solved();
  EXPECT_FALSE(app::scene_of(data, settings, app::picture_scale(data, settings)).markers.visible);
}

TEST(PictureSceneOfView, KeepsLinesAsWideForThePictureAtAnySize) {
  PictureSettings settings;
  settings.width = 2560;
  settings.height = 1440;
  const PictureData data = solved();
  EXPECT_EQ(app::scene_of(data, settings, app::picture_scale(data, settings)).pixel_scale, 2);
}

TEST(PictureSceneOfView, HasMarkersAsLargeAsLettersAskFor) {
  PictureSettings settings;
  settings.width = 700;
  settings.height = 600;
  const PictureData data = solved();
  const auto radius = [&](std::optional<double> text) {
    if (text) settings.text_size = app::PaperLength{*text};
    const engine::Scene scene = app::scene_of(data, settings, app::picture_scale(data, settings));
    return scene.markers.radius * scene.pixel_scale;
  };
  const float usual = radius({});
  EXPECT_EQ(radius(8), usual) << "small letters leave them as they are";
  EXPECT_NEAR(radius(40), 2 * radius(20), 1e-3F);
  EXPECT_GT(radius(40), 1.5F * usual);
}

TEST(PictureLegend, HasABarWithTicksAndIsolinesInPlace) {
  PictureSettings settings;
  settings.range_max = 10;
  settings.line_spacing = 2;
  const engine::Legend legend = legend_of(settings);
  EXPECT_TRUE(legend.bar);
  EXPECT_EQ(legend.caption, "cap");
  EXPECT_NE(legend.title.find("distance"), std::string::npos);
  ASSERT_EQ(legend.ticks.size(), 6U);
  EXPECT_EQ(legend.ticks[3].label, "6");
  EXPECT_NEAR(legend.ticks[3].position, 0.6F, kFloatRounding);
  ASSERT_EQ(legend.lines.size(), 4U);  // at 2, 4, 6 and 8
  EXPECT_NEAR(legend.lines[0], 0.2F, kFloatRounding);
}

TEST(PictureLegend, LeavesOutWhatIsNotWanted) {
  PictureSettings settings;
  settings.bar = settings.caption = false;
  const engine::Legend legend = legend_of(settings);
  EXPECT_FALSE(legend.bar);
  EXPECT_EQ(legend.caption, "");
}

TEST(PictureLegend, TurnsItsColoursRoundAndItsInkWithTheBackground) {
  PictureSettings settings;
  const engine::Legend usual = legend_of(settings);
  settings.reverse = true;
  settings.background = app::PictureBackground::kDark;
  const engine::Legend turned = legend_of(settings);
  EXPECT_LE(glm::length(usual.colours.front() - turned.colours.back()), kFloatRounding);
  EXPECT_LT(usual.ink.r, 0.5F);
  EXPECT_GT(turned.ink.r, 0.5F);
}

TEST(PictureLegend, OfCountlessIsolinesShowsNone) {
  PictureSettings settings;
  settings.line_spacing = 1e-12;
  EXPECT_TRUE(legend_of(settings).lines.empty());
}

TEST(PictureLegend, SaysWhatTheColoursOfArrowsAre) {
  PictureSettings settings;
  EXPECT_TRUE(legend_of(settings).keys.empty());
  settings.view = app::View::kGradientError;
  EXPECT_EQ(legend_of(settings).keys.size(), 2U);
  settings.bar = false;
  EXPECT_TRUE(legend_of(settings).keys.empty());
}

TEST(PictureLegend, SaysHowManyRegionsThereAre) {
  PictureData data = solved();
  data.nearest = {0, 3, 3, kNoIndex, 7};
  PictureSettings settings;
  settings.view = View::kRegions;
  const auto scale = app::picture_scale(data, settings);
  const engine::Legend legend = app::legend_of(data, settings, scale);
  EXPECT_FALSE(legend.bar);
  ASSERT_EQ(legend.keys.size(), 1U);
  EXPECT_EQ(legend.keys[0].label, "nearest source (3)");
  const std::vector<glm::vec3> drawn = {engine::region_colour(0), engine::region_colour(3),
                                        engine::region_colour(7)};
  EXPECT_EQ(legend.keys[0].patches, drawn);
  data.unreached = true;
  const auto keys = app::legend_of(data, settings, scale).keys;
  ASSERT_EQ(keys.size(), 2U) << "what is grey is said";
  EXPECT_EQ(keys[1].label, "not reached");
}

TEST(PictureLegend, NamesEachLineOnce) {
  PictureData data = solved();
  const std::vector<Vec3> points = {Vec3::Zero(), Vec3::Ones()};
  for (const char* name : {"heat", "geodesic", "heat", ""}) app::add_line(data, points, name);
  PictureSettings settings;
  settings.path_kind = app::PathKind::kAll;
  const auto scale = app::picture_scale(data, settings);
  const engine::Legend legend = app::legend_of(data, settings, scale);
  ASSERT_EQ(legend.keys.size(), 2U);
  EXPECT_EQ(legend.keys[0].label, "heat");
  EXPECT_EQ(legend.keys[1].label, "geodesic");
  EXPECT_NE(legend.keys[0].colour, legend.keys[1].colour);
  EXPECT_TRUE(app::scene_of(data, settings, scale).lines.visible);
}

/// A long thin model seen from the side fills the room that the bar leaves, and stays in its
/// middle.
TEST(PictureCamera, FillsTheRoomWithTheModelWhenAsked) {
  std::vector<glm::vec3> points;
  for (int k = 0; k <= 20; ++k) {
    const float x = 0.1F * static_cast<float>(k) - 1;
    points.emplace_back(x, 0.05F * x * x, 0.05F * std::sin(9 * x));
  }
  const glm::vec2 extent(900, 500);
  const engine::Insets insets{0, 0, 120, 40};
  app::CameraSettings from;
  from.fit = app::PictureFit::kSphere;
  from.azimuth = 40;
  from.zoom = 0.3;
  from.pan_up = 0.7;
  const app::CameraSettings tight = app::tight_camera({}, from, points, extent, insets);
  const engine::Camera camera = app::camera_of({}, tight, points, extent, insets);
  glm::vec2 low(1e9F), high(-1e9F);
  for (const glm::vec3& point : points) {
    low = glm::min(low, glm::vec2(camera.project(point)));
    high = glm::max(high, glm::vec2(camera.project(point)));
  }
  const glm::vec2 middle = app::lens_centre(extent, insets);
  EXPECT_LT(glm::distance((low + high) / 2.0F, middle), 0.1F);  // pixels
  EXPECT_NEAR(high.x - low.x, 2 * std::min(middle.x, extent.x - insets.right - middle.x), 0.1F);
  EXPECT_EQ(tight.azimuth, from.azimuth);
}

TEST(PictureCamera, LeavesAMarginAboutTheModel) {
  const std::vector<glm::vec3> points = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  const glm::vec2 extent(400, 200);
  const engine::Camera camera = app::camera_of({}, {}, points, extent, {});
  for (const glm::vec3& point : points) {
    const glm::vec3 at = camera.project(point);
    EXPECT_GE(at.y, 5);
    EXPECT_LE(at.y, extent.y - 5);
  }
}

}  // namespace
}  // namespace geotherm::test
