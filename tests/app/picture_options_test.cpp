// SPDX-License-Identifier: MIT
#include "app/picture/picture_options.h"

#include <gtest/gtest.h>

#include "app/picture/picture_text.h"

namespace geotherm::test {
namespace {

using app::parse_view;
using app::picture_settings;
using app::PictureArguments;
using app::PictureFit;
using app::PictureSettings;

const std::vector<std::string> kMaps = {"red-blue", "viridis"};

TEST(PictureOptions, AreTheDefaultsOfTheSettingsWhenNothingIsTyped) {
  const auto settings = picture_settings({}, kMaps);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(*settings, PictureSettings());
}

TEST(PictureOptions, ReachTheSettings) {
  PictureArguments a;
  a.view = "gradient-error";
  a.size = "8192x17";
  a.samples = "1";
  a.colour_map = "viridis";
  a.reverse = a.no_bar = a.no_caption = a.no_markers = true;
  a.range = "-0.5:2e3";
  a.spacing = "0";
  a.light = "headlight";
  a.background = "transparent";
  a.azimuth = "-400";
  a.elevation = "-90";
  a.zoom = "2.5";
  a.pan = "0.1:-.25";
  a.fit = "sphere";
  a.projection = "orthographic";
  a.turntable = "12";
  a.device = "llvm";
  const auto s = picture_settings(a, kMaps);
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->view, app::View::kGradientError);
  EXPECT_EQ(s->width, 8192);
  EXPECT_EQ(s->height, 17);
  EXPECT_EQ(s->samples, 1);
  EXPECT_EQ(s->colour_map, "viridis");
  EXPECT_TRUE(s->reverse);
  EXPECT_FALSE(s->bar || s->caption || s->markers);
  EXPECT_EQ(s->range_min, -0.5);
  EXPECT_EQ(s->range_max, 2000);
  EXPECT_EQ(s->line_spacing, 0);
  EXPECT_EQ(s->light, app::PictureLight::kHeadlight);
  EXPECT_EQ(s->background, app::PictureBackground::kTransparent);
  EXPECT_EQ(s->camera.azimuth, -400);
  EXPECT_EQ(s->camera.elevation, -90);
  EXPECT_EQ(s->camera.zoom, 2.5);
  EXPECT_EQ(s->camera.pan_right, 0.1);
  EXPECT_EQ(s->camera.pan_up, -0.25);
  EXPECT_TRUE(s->camera.orthographic);
  EXPECT_EQ(s->camera.fit, PictureFit::kSphere);
  EXPECT_EQ(s->turntable, 12);
  EXPECT_EQ(s->device, "llvm");
}

TEST(PictureOptions, MayLeaveOneEndOfTheRangeOpen) {
  PictureArguments a;
  a.range = ":3";
  EXPECT_EQ(picture_settings(a, kMaps)->range_max, 3);
  EXPECT_FALSE(picture_settings(a, kMaps)->range_min);
  a.range = "1:";
  EXPECT_EQ(picture_settings(a, kMaps)->range_min, 1);
}

TEST(PictureOptions, OfATurntableFitTheSphereUnlessToldOtherwise) {
  PictureArguments a;
  a.turntable = "4";
  EXPECT_EQ(picture_settings(a, kMaps)->camera.fit, PictureFit::kSphere);
  a.fit = "tight";
  EXPECT_EQ(picture_settings(a, kMaps)->camera.fit, PictureFit::kTight);
}

TEST(PictureOptions, OfABareFitAreTight) {
  const auto completed = [](std::vector<std::string> words) {
    app::complete_bare_fit(words);
    return words;
  };
  using Words = std::vector<std::string>;
  EXPECT_EQ(completed({"--fit", "a.obj"}), (Words{"--fit=tight", "a.obj"}));
  EXPECT_EQ(completed({"a.obj", "--fit"}), (Words{"a.obj", "--fit=tight"}));
  EXPECT_EQ(completed({"--fit", "sphere"}), (Words{"--fit", "sphere"}));
  EXPECT_EQ(completed({"--fit=sphere"}), (Words{"--fit=sphere"}));
}

TEST(PictureText, ReadsBack) {
  for (const std::string& name : app::view_names()) EXPECT_EQ(to_text(*parse_view(name)), name);
  for (const std::string& name : app::light_names()) {
    EXPECT_EQ(to_text(*app::parse_light(name)), name);
  }
  for (const std::string& name : app::background_names()) {
    EXPECT_EQ(to_text(*app::parse_background(name)), name);
  }
  for (const std::string& name : app::fit_names()) {
    EXPECT_EQ(to_text(*app::parse_fit(name)), name);
  }
  EXPECT_EQ(app::view_names().front(), "contours");
  EXPECT_EQ(app::view_names().size(), 13U);
}

struct Wrong {
  const char* name;
  std::string PictureArguments::*option;
  std::string value;
  std::vector<std::string> says;
};

class PictureOptionsWrong : public testing::TestWithParam<Wrong> {};

TEST_P(PictureOptionsWrong, SayOptionValueAndCure) {
  PictureArguments arguments;
  arguments.*GetParam().option = GetParam().value;
  const auto settings = picture_settings(arguments, kMaps);
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings.error().code, ErrorCode::kBadInput);
  const std::string message = sentence(settings.error());
  EXPECT_NE(message.find("'" + GetParam().value + "'"), std::string::npos) << message;
  for (const std::string& part : GetParam().says) {
    EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in " << message;
  }
}

using Arguments = PictureArguments;
INSTANTIATE_TEST_SUITE_P(
    Of, PictureOptionsWrong,
    testing::Values(
        Wrong{"View", &Arguments::view, "heat", {"--view", "contours, wireframe"}},
        Wrong{"Size", &Arguments::size, "800", {"--size", "WxH", "1920x1080"}},
        Wrong{"SizeZero", &Arguments::size, "0x10", {"--size", "1 to 8192"}},
        Wrong{"SizeHuge", &Arguments::size, "8193x10", {"--size", "1 to 8192"}},
        Wrong{"SizeTail", &Arguments::size, "10x10x10", {"--size"}},
        Wrong{"Samples", &Arguments::samples, "2", {"--samples", "1 or 4"}},
        Wrong{"ColourMap", &Arguments::colour_map, "jet", {"--colour-map", "red-blue, viridis"}},
        Wrong{"Range", &Arguments::range, "1", {"--range", "MIN:MAX"}},
        Wrong{"RangeTurned", &Arguments::range, "2:1", {"--range", "MIN below MAX"}},
        Wrong{"RangeEmpty", &Arguments::range, "1:1", {"--range"}},
        Wrong{"RangeOpen", &Arguments::range, ":", {"--range"}},
        Wrong{"RangeInfinite", &Arguments::range, "0:inf", {"--range"}},
        Wrong{"Spacing", &Arguments::spacing, "-1", {"--spacing", "0 for none"}},
        Wrong{"SpacingNan", &Arguments::spacing, "nan", {"--spacing"}},
        Wrong{"Light", &Arguments::light, "sun", {"--light", "three-point, headlight, none"}},
        Wrong{"Background", &Arguments::background, "red", {"--background", "light, dark"}},
        Wrong{"Azimuth", &Arguments::azimuth, "north", {"--azimuth", "degrees"}},
        Wrong{"AzimuthNan", &Arguments::azimuth, "nan", {"--azimuth"}},
        Wrong{"Elevation", &Arguments::elevation, "91", {"--elevation", "-90", "to 90"}},
        Wrong{"Zoom", &Arguments::zoom, "0", {"--zoom", "0.001"}},
        Wrong{"Pan", &Arguments::pan, "1", {"--pan", "RIGHT:UP"}},
        Wrong{"PanText", &Arguments::pan, "1:up", {"--pan"}},
        Wrong{"Fit", &Arguments::fit, "loose", {"--fit", "tight, sphere"}},
        Wrong{"Projection", &Arguments::projection, "fisheye", {"--projection", "orthographic"}},
        Wrong{"Turntable", &Arguments::turntable, "0", {"--turntable", "1 to 3600"}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace geotherm::test
