// SPDX-License-Identifier: MIT
// What figures of papers need: scales, bands, labels, sizes on paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "app/drawing/picture_camera.h"
#include "app/drawing/picture_scene.h"
#include "app/picture/picture_text.h"
#include "app/picture/png_file.h"
#include "app/session/settings.h"

namespace geotherm::test {
namespace {

using app::ColourScale;
using app::NumberFormat;
using app::NumberStyle;
using app::PaperUnit;
using app::PictureData;
using app::PictureScale;
using app::PictureSettings;
using app::View;

/// One face with these distances at its corners.
PictureData face_with(const std::vector<double>& distances) {
  PictureData data;
  data.faces = {{0, 1, 2}};
  app::add_distances(data, distances);
  return data;
}

engine::Legend legend_of(const PictureData& data, const PictureSettings& settings) {
  return app::legend_of(data, settings, app::picture_scale(data, settings));
}

std::string setting_after(PictureSettings& picture, const char* name, const std::string& text) {
  app::ViewerState state;
  state.picture = picture;
  const auto set = app::find_setting(name)->set(state, text);
  if (!set) return set.error().message;
  picture = state.picture;
  return app::find_setting(name)->get(state);
}

PictureData field_on_a_face(const std::vector<double>& values) {
  PictureData data;
  data.faces = {{0, 1, 2}};
  app::add_field(data, values);
  return data;
}

TEST(FieldScale, OfOneSignRunsBetweenItsOwnEnds) {
  const PictureScale scale = app::picture_scale(field_on_a_face({100, 102, 101}), {});
  EXPECT_EQ(scale.min, 100);
  EXPECT_EQ(scale.max, 102);
  ASSERT_GT(scale.levels.size(), 5U);
  EXPECT_GT(scale.levels.front(), 100);
  EXPECT_LT(scale.levels.back(), 102);
}

TEST(FieldScale, TellsValuesApartThatAreFarFromZero) {
  const PictureData data = field_on_a_face({1e8, 1e8 + 1, 1e8 + 0.5});
  EXPECT_EQ(data.values, (std::vector<float>{0, 1, 0.5F}));
  const PictureScale scale = app::picture_scale(data, {});
  EXPECT_EQ(scale.min, 1e8);
  EXPECT_EQ(scale.max, 1e8 + 1);
  EXPECT_EQ(scale.ticks.values.front(), 1e8) << "a mark at the lower end";
  const auto style = app::scene_of(data, {}, scale).surface;
  EXPECT_EQ(style.range_min, 0);
  EXPECT_EQ(style.range_max, 1);
  ASSERT_EQ(style.levels.size(), 19U);
  for (std::size_t i = 0; i < 19; ++i) {
    EXPECT_NEAR(style.levels[i], 0.05 * static_cast<double>(i + 1), 1e-6);
  }
}

TEST(FieldScale, OfOneValueHasItInTheMiddleAndNoIsolines) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  for (const std::vector<double>& values :
       {std::vector<double>{5, 5, 5}, {-5, -5, -5}, {1, 1 - kEpsilon, 1 + kEpsilon}}) {
    const PictureData data = field_on_a_face(values);
    EXPECT_LT(*std::ranges::max_element(data.values), 1e-6F) << "noise is one colour";
    const PictureScale scale = app::picture_scale(data, {});
    EXPECT_DOUBLE_EQ(scale.value_at(0.5), values[0]);
    EXPECT_DOUBLE_EQ(scale.max - scale.min, std::abs(values[0]));
    EXPECT_TRUE(scale.levels.empty());
    EXPECT_EQ(scale.spacing, 0);
    EXPECT_TRUE(scale.coloured && scale.bar && !scale.below && !scale.above);
  }
}

TEST(FieldScale, HasNoIsolinesInARangeOfRounding) {
  PictureSettings settings;
  settings.range_min = 1;
  settings.range_max = 1 + 4 * std::numeric_limits<double>::epsilon();
  const PictureScale scale = app::picture_scale(field_on_a_face({1, 2, 3}), settings);
  EXPECT_EQ(scale.spacing, 0);
  EXPECT_TRUE(scale.levels.empty());
}

TEST(FieldScale, HasTheLogarithmOfTheValuesThemselves) {
  PictureSettings settings;
  settings.colour_scale = ColourScale::kLog;
  const PictureData data = field_on_a_face({2, 18, 6});
  const auto style = app::scene_of(data, settings, app::picture_scale(data, settings)).surface;
  EXPECT_FLOAT_EQ(style.log_offset, 2.0F / 16);
  EXPECT_FLOAT_EQ(style.range_min + style.log_offset, 2.0F / 16);
  EXPECT_FLOAT_EQ(style.range_max + style.log_offset, 20.0F / 16);
}

TEST(FieldScale, OfBothSignsHasZeroInTheMiddleAndLinesBelowIt) {
  const PictureScale scale = app::picture_scale(field_on_a_face({-1, 2, 0.5}), {});
  EXPECT_EQ(scale.min, -2);
  EXPECT_EQ(scale.max, 2);
  EXPECT_TRUE(std::ranges::count(scale.levels, 0) == 1);
  EXPECT_LT(scale.levels.front(), -1);
}

TEST(DifferenceScale, HasLinesOnBothSidesOfZeroThatPictureAndLegendShare) {
  PictureData data;
  data.faces = {{0, 1, 2}};
  app::add_difference(data, std::vector<double>{-1, 0.5, 0});
  PictureSettings settings;
  settings.line_spacing = 0.25;
  const PictureScale scale = app::picture_scale(data, settings);
  EXPECT_EQ(scale.levels, (std::vector<double>{-0.75, -0.5, -0.25, 0.25, 0.5, 0.75}));
  EXPECT_EQ(app::scene_of(data, settings, scale).surface.levels.size(), scale.levels.size());
  EXPECT_EQ(legend_of(data, settings).lines.size(), scale.levels.size());
  settings.line_spacing = 1.5;
  EXPECT_TRUE(legend_of(data, settings).lines.empty()) << "0 is no line";
}

TEST(FieldScale, HasRoundBordersOfItsBands) {
  PictureSettings settings;
  settings.bands = 5;
  for (const auto& values :
       {std::vector<double>{-0.81, 1.43, 0}, {37.2, 38.9, 38}, {-9, -7.1, -8}}) {
    const PictureScale scale = app::picture_scale(field_on_a_face(values), settings);
    EXPECT_LE(scale.min, *std::ranges::min_element(values) + 1e-5);
    EXPECT_GE(scale.max, *std::ranges::max_element(values) - 1e-5);
    ASSERT_EQ(scale.levels.size(), 4U);
    for (const double level : scale.levels) {
      EXPECT_NEAR(std::remainder(level, 0.05), 0, 1e-9) << "of " << values[0];
    }
  }
}

TEST(LogScale, HasItsEndsAndTheBordersOfBandsAtTheBar) {
  const PictureData data = face_with({0, 0.011, 1.9});
  PictureSettings settings;
  settings.colour_scale = ColourScale::kLog;
  EXPECT_EQ(app::picture_scale(data, settings).ticks.values,
            (std::vector<double>{0.01, 0.1, 1, 2}));
  settings.bands = 4;
  const PictureScale scale = app::picture_scale(data, settings);
  ASSERT_EQ(scale.ticks.values.size(), 5U);
  for (std::size_t i = 0; i < scale.levels.size(); ++i) {
    EXPECT_EQ(scale.ticks.values[i + 1], scale.levels[i]);
  }
}

TEST(LogScale, EndsAtNumbersThatBeginWithOneTwoOrFiveAndLeavesZeroOut) {
  const PictureData data = face_with({0, 0.03, 7});
  PictureSettings settings;
  settings.colour_scale = ColourScale::kLog;
  const PictureScale scale = app::picture_scale(data, settings);
  EXPECT_EQ(scale.min, 0.02);
  EXPECT_EQ(scale.max, 10);
  EXPECT_NEAR(scale.place_of(0.1), std::log(5) / std::log(500), 1e-12);
  EXPECT_EQ(scale.place_of(0), 0);
  EXPECT_FALSE(scale.below) << "the source alone is";
  EXPECT_FALSE(scale.ticks.values.empty());
  for (const double level : scale.levels) EXPECT_GT(level, 0);
  const auto style = app::scene_of(data, settings, scale).surface;
  EXPECT_TRUE(style.log);
  EXPECT_EQ(style.levels.size(), scale.levels.size());
}

TEST(LogScale, TakesARangeAndSaysWhatLiesBeyondIt) {
  const PictureData data = face_with({0, 0.03, 7});
  PictureSettings settings;
  settings.colour_scale = ColourScale::kLog;
  settings.range_min = 0.1;
  settings.range_max = 3;
  const PictureScale scale = app::picture_scale(data, settings);
  EXPECT_EQ(scale.min, 0.1);
  EXPECT_EQ(scale.max, 3);
  EXPECT_TRUE(scale.below);
  EXPECT_TRUE(scale.above);
}

TEST(DivergingScale, HasZeroInTheMiddleAndRoundEnds) {
  PictureData data = face_with({0, 1, 2});
  app::add_error(data, std::vector<double>{-0.013, 0.002, 0.007}, "error");
  PictureSettings settings;
  settings.view = View::kExactError;
  EXPECT_DOUBLE_EQ(app::picture_scale(data, settings).max, 0.013) << "without it";
  settings.colour_scale = ColourScale::kDiverging;
  const PictureScale scale = app::picture_scale(data, settings);
  EXPECT_EQ(scale.max, 0.02);
  EXPECT_EQ(scale.min, -0.02);
  EXPECT_EQ(scale.place_of(0), 0.5);
  settings.range_max = 0.01;
  EXPECT_EQ(app::picture_scale(data, settings).min, -0.01);
  EXPECT_TRUE(app::picture_scale(data, settings).below);
  EXPECT_FALSE(app::picture_scale(data, settings).above);
  settings.range_min = -0.5;
  EXPECT_EQ(app::picture_scale(data, settings).max, 0.5) << "the farther end is that of both";
  settings.range_max.reset();
  EXPECT_EQ(app::picture_scale(data, settings).max, 0.5);
}

TEST(Bands, AreAsManyColoursWithRoundNumbersBetweenThem) {
  const PictureData data = face_with({0, 1, 2.637});
  PictureSettings settings;
  settings.bands = 6;
  const PictureScale scale = app::picture_scale(data, settings);
  EXPECT_EQ(scale.max, 3);
  EXPECT_EQ(scale.levels, (std::vector<double>{0.5, 1, 1.5, 2, 2.5}));
  EXPECT_EQ(scale.ticks.labels,
            (std::vector<std::string>{"0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"}));
  const auto less = [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  const engine::Legend legend = legend_of(data, settings);
  std::set<glm::vec3, decltype(less)> colours(legend.colours.begin(), legend.colours.end(), less);
  EXPECT_EQ(colours.size(), 6U);
}

TEST(LineValues, TakeThePlaceOfASpacing) {
  const PictureData data = face_with({0, 1, 8});
  PictureSettings settings;
  settings.line_values = {0.5, 2, 20};
  const PictureScale scale = app::picture_scale(data, settings);
  EXPECT_EQ(scale.levels, settings.line_values);
  EXPECT_EQ(scale.spacing, 0);
  EXPECT_EQ(legend_of(data, settings).lines, (std::vector<float>{0.0625F, 0.25F}));
  EXPECT_EQ(app::scene_of(data, settings, scale).surface.levels[1], 0.25F) << "of the largest";
}

TEST(Clamped, AreTheEndsThatValuesLieBeyond) {
  const PictureData data = face_with({0, 1, 8});
  PictureSettings settings;
  EXPECT_FALSE(legend_of(data, settings).above);
  settings.range_max = 5;
  EXPECT_TRUE(legend_of(data, settings).above);
  EXPECT_FALSE(legend_of(data, settings).below);
  settings.range_min = 1;
  EXPECT_TRUE(legend_of(data, settings).below);
}

TEST(NotReached, StandsInTheLegendWhereAFaceHasNoDistance) {
  PictureData data = face_with({0, 1, kUnreached});
  PictureSettings settings;
  ASSERT_EQ(legend_of(data, settings).keys.size(), 1U);
  EXPECT_EQ(legend_of(data, settings).keys[0].label, "not reached");
  EXPECT_TRUE(legend_of(face_with({0, 1, 2, kUnreached}), settings).keys.empty()) << "of no face";
  settings.view = View::kSmooth;
  EXPECT_TRUE(legend_of(data, settings).keys.empty());
}

TEST(BarTitle, IsWhatWasAskedForWithItsUnits) {
  const PictureData data = face_with({0, 1, 2});
  PictureSettings settings;
  EXPECT_EQ(app::bar_title(data, settings), "distance (model\u00a0units)");
  settings.units = "mm";
  EXPECT_EQ(app::bar_title(data, settings), "distance (mm)");
  settings.bar_label = "length of the way";
  EXPECT_EQ(app::bar_title(data, settings), "length of the way (mm)");
  settings.units.clear();
  EXPECT_EQ(app::bar_title(data, settings), "length of the way");
}

TEST(NumberFormats, WriteTheLabelsAnew) {
  const auto labels = [](const std::string& text) {
    app::Ticks ticks = app::make_ticks(0, 2000, 5);
    const auto format = app::parse_number_format(text);
    EXPECT_TRUE(format) << text;
    if (format) app::format_labels(ticks, *format);
    return ticks.labels;
  };
  using TickLabels = std::vector<std::string>;
  EXPECT_EQ(labels("auto"), (TickLabels{"0", "500", "1000", "1500", "2000"}));
  EXPECT_EQ(labels("fixed:1"), (TickLabels{"0.0", "500.0", "1000.0", "1500.0", "2000.0"}));
  EXPECT_EQ(labels("scientific:1"), (TickLabels{"0.0e0", "5.0e2", "1.0e3", "1.5e3", "2.0e3"}));
  EXPECT_EQ(labels("significant:2"), (TickLabels{"0", "5e+02", "1e+03", "1.5e+03", "2e+03"}));
  for (const char* wrong : {"%d", "fixed:", "fixed:13", "significant:0", "auto:2", "fixed:-1"}) {
    const auto format = app::parse_number_format(wrong);
    ASSERT_FALSE(format) << wrong;
    EXPECT_NE(sentence(format.error()).find("fixed:2"), std::string::npos);
  }
}

TEST(SizesOnPaper, BecomePixelsByTheDotsOfAnInch) {
  PictureSettings picture;
  EXPECT_EQ(setting_after(picture, "size", "8cmx6cm"), "8cmx6cm");
  EXPECT_EQ(picture.width, 945);
  EXPECT_EQ(picture.height, 709);
  EXPECT_EQ(app::said_dpi(picture), 300);
  EXPECT_EQ(setting_after(picture, "dpi", "150"), "150");
  EXPECT_EQ(picture.width, 472);
  EXPECT_NE(setting_after(picture, "size", "40cmx100in").find("15000"), std::string::npos);
  EXPECT_EQ(setting_after(picture, "size", "640x480"), "640x480");
  EXPECT_EQ(app::pixels_of({8, PaperUnit::kPoint}, picture), 8.0 * 150 / 72);
  EXPECT_EQ(setting_after(picture, "line-width", "0.5pt"), "0.5pt");
  EXPECT_EQ(setting_after(picture, "text-size", "12"), "12");
  for (const char* wrong : {"8cm", "8cmx6", "0cmx1cm", "x", "1kmx1km"}) {
    EXPECT_NE(setting_after(picture, "size", wrong).find("is no size"), std::string::npos) << wrong;
  }
  EXPECT_NE(setting_after(picture, "line-width", "thick").find("is no length"), std::string::npos);
}

TEST(LineWidth, IsThatOfIsolinesInPixelsAndOthersKeepTheirProportions) {
  const PictureData data = face_with({0, 1, 2});
  PictureSettings settings;
  settings.width = settings.height = 1440;  // widths are twice the usual ones
  const auto usual = app::scene_of(data, settings, app::picture_scale(data, settings));
  settings.line_width = {5, PaperUnit::kPixel};
  const auto wide = app::scene_of(data, settings, app::picture_scale(data, settings));
  EXPECT_NEAR(wide.surface.line_width * wide.pixel_scale, 5, 1e-4);
  EXPECT_NEAR(wide.lines.width / wide.surface.line_width,
              usual.lines.width / usual.surface.line_width, 1e-4);
}

TEST(PathKinds, ChooseWhichPathsAreDrawn) {
  PictureData data = face_with({0, 1, 2});
  for (const char* name : {"heat", "distance", "geodesic"}) {
    app::add_line(data, std::vector<Vec3>{Vec3::Zero(), Vec3::Ones()}, name);
  }
  PictureSettings settings;
  ASSERT_EQ(legend_of(data, settings).keys.size(), 1U);
  EXPECT_EQ(legend_of(data, settings).keys[0].label, "geodesic");
  settings.path_kind = app::PathKind::kAll;
  EXPECT_EQ(legend_of(data, settings).keys.size(), 3U);
  EXPECT_TRUE(app::shows_line({}, "a line of its own"));
}

TEST(PngFile, SaysHowManyPixelsAnInchHas) {
  const app::DrawnPicture picture{1, 1, {1, 2, 3, 255}};
  const auto chunk = [&](std::optional<int> dpi) {
    const std::string bytes = *app::png_bytes(picture, {}, dpi);
    const std::size_t at = bytes.find("pHYs");
    return at == bytes.npos ? std::string() : bytes.substr(at + 4, 9);
  };
  EXPECT_EQ(chunk({}), "");
  EXPECT_EQ(chunk(300), std::string("\0\0\x2e\x23\0\0\x2e\x23\1", 9)) << "11,811 a metre";
}

TEST(UpAxes, TurnTheCameraAndAreLeftToTheFileWhereNobodySays) {
  PictureData data = face_with({0, 1, 2});
  const std::vector<glm::vec3> points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  const auto up_on_screen = [&](app::UpAxis up, const glm::vec3& axis) {
    app::CameraSettings camera;
    camera.elevation = 0;
    camera.up = up;
    const auto made = app::camera_of(data, camera, points, {400, 400}, {});
    return (made.view * glm::vec4(axis, 0)).y;
  };
  EXPECT_NEAR(up_on_screen(app::UpAxis::kAuto, {0, 1, 0}), 1, 1e-6);
  EXPECT_NEAR(up_on_screen(app::UpAxis::kZ, {0, 0, 1}), 1, 1e-6);
  EXPECT_NEAR(up_on_screen(app::UpAxis::kMinusX, {-1, 0, 0}), 1, 1e-6);
  data.up = app::UpAxis::kZ;
  EXPECT_NEAR(up_on_screen(app::UpAxis::kAuto, {0, 0, 1}), 1, 1e-6) << "as the file says";
  EXPECT_NEAR(up_on_screen(app::UpAxis::kY, {0, 1, 0}), 1, 1e-6);
  for (const app::UpAxis up : {app::UpAxis::kX, app::UpAxis::kMinusX, app::UpAxis::kMinusY,
                               app::UpAxis::kZ, app::UpAxis::kMinusZ}) {
    const auto axes = app::axes_of(up);
    glm::dmat3 m;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        m[k][j] = axes[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
      }
    }
    EXPECT_EQ(glm::determinant(m), 1) << "no mirror";
  }
}

}  // namespace
}  // namespace geotherm::test
