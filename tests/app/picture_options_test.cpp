// SPDX-License-Identifier: MIT
#include "app/cli/options.h"

#include <gtest/gtest.h>

#include "app/picture/picture_text.h"

namespace geotherm::test {
namespace {

using app::PictureArguments;
using app::PictureFit;
using app::PictureSettings;
using app::SettingArguments;

const std::vector<std::string> kMaps = {"red-blue", "viridis"};

Result<PictureSettings> picture_settings(const SettingArguments& typed,
                                         const PictureArguments& arguments,
                                         const std::vector<std::string>& maps) {
  const auto asked = app::settings_in(typed);
  if (!asked) return asked.error();
  return app::picture_settings(*asked, typed, arguments, maps);
}

TEST(PictureOptions, AreTheDefaultsOfTheSettingsWhenNothingIsTyped) {
  const auto settings = picture_settings({}, {}, kMaps);
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(*settings, PictureSettings());
}

TEST(PictureOptions, ReachTheSettings) {
  const SettingArguments typed{
      {{"view", "gradient-error"}, {"size", "8192x17"},     {"samples", "1"},
       {"colour-map", "viridis"},  {"reverse", "on"},       {"bar", "off"},
       {"caption", "off"},         {"markers", "off"},      {"range", "-0.5:2e3"},
       {"spacing", "0"},           {"light", "headlight"},  {"background", "transparent"},
       {"azimuth", "-400"},        {"elevation", "-90"},    {"zoom", "2.5"},
       {"pan", "0.1:-.25"},        {"fit", "sphere"},       {"slice", "-y"},
       {"slice-at", "0.25"},       {"peel", "above:0.125"}, {"projection", "orthographic"}}};
  const auto s = picture_settings(typed, {"12", "llvm"}, kMaps);
  ASSERT_TRUE(s) << s.error().message;
  EXPECT_EQ(s->slice, (std::array<double, 3>{0, -1, 0}));
  EXPECT_EQ(s->slice_at, 0.25);
  EXPECT_EQ(s->peel, (app::Peel{app::PeelSide::kAbove, 0.125}));
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
  const auto settings = picture_settings({{{"range", ":3"}}}, {}, kMaps);
  EXPECT_EQ(settings->range_max, 3);
  EXPECT_FALSE(settings->range_min);
  EXPECT_EQ(picture_settings({{{"range", "1:"}}}, {}, kMaps)->range_min, 1);
}

TEST(PictureOptions, OfATurntableFitTheSphereUnlessToldOtherwise) {
  const PictureArguments turns{"4", ""};
  EXPECT_EQ(picture_settings({}, turns, kMaps)->camera.fit, PictureFit::kSphere);
  EXPECT_EQ(picture_settings({{{"fit", "tight"}}}, turns, kMaps)->camera.fit, PictureFit::kTight);
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

template <class Enum>
void expect_read_back() {
  for (const std::string& name : all_names<Enum>()) EXPECT_EQ(to_text(*parse<Enum>(name)), name);
}

TEST(PictureOptions, HintAtASettingByItsNameAndValue) {
  SettingArguments typed;
  typed.texts = {{"centre", "0:0:0"}, {"fit", "tight"}};
  const auto settings = picture_settings(typed, {}, kMaps);
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings_of(settings.error().hint), (std::vector<SettingHint>{{"fit", {"sphere"}}}));

  typed.texts = {{"method", "exact"}, {"boundary", "dirichlet"}};
  std::vector<Warning> warnings;
  app::note_unused_settings(typed, app::settings_in(typed)->options, warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(settings_of(warnings[0].hint), (std::vector<SettingHint>{{"method", {"heat"}}}));
}

TEST(PictureText, OfSliceAndPeelReadsBack) {
  for (const char* text : {"off", "x", "-z", "1:0.5:-2"}) {
    PictureSettings settings;
    settings.slice = *app::parse_slice(text);
    EXPECT_EQ(app::slice_text(settings), text);
  }
  EXPECT_EQ(app::parse_slice("0:-1:0")->value(), app::parse_slice("-y")->value());
  for (const char* text : {"off", "below:0.25", "above:1"}) {
    EXPECT_EQ(app::peel_text(*app::parse_peel(text)), text);
  }
  EXPECT_EQ(app::peel_text(*app::parse_peel("below")), "below:0.5");
}

TEST(PictureText, ReadsBack) {
  expect_read_back<app::View>();
  expect_read_back<app::PictureLight>();
  expect_read_back<app::PictureBackground>();
  expect_read_back<PictureFit>();
  expect_read_back<app::PeelSide>();
  EXPECT_EQ(all_names<app::View>().front(), "contours");
  EXPECT_EQ(all_names<app::View>().size(), 13U);
}

struct Wrong {
  const char* name;
  std::string setting;
  std::string value;
  std::vector<std::string> says;
};

class PictureOptionsWrong : public testing::TestWithParam<Wrong> {};

TEST_P(PictureOptionsWrong, SayOptionValueAndCure) {
  PictureArguments arguments;
  SettingArguments typed;
  if (GetParam().setting == "turntable") {
    arguments.turntable = GetParam().value;
  } else {
    typed.texts[GetParam().setting] = GetParam().value;
  }
  const auto settings = picture_settings(typed, arguments, kMaps);
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings.error().code, ErrorCode::kBadInput);
  const std::string message = sentence(settings.error());
  EXPECT_NE(message.find("'" + GetParam().value + "'"), std::string::npos) << message;
  for (const std::string& part : GetParam().says) {
    EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, PictureOptionsWrong,
    testing::Values(Wrong{"View", "view", "heat", {"--view", "contours, wireframe"}},
                    Wrong{"Size", "size", "800", {"--size", "WxH", "1920x1080"}},
                    Wrong{"SizeZero", "size", "0x10", {"--size", "1 to 8192"}},
                    Wrong{"SizeHuge", "size", "8193x10", {"--size", "1 to 8192"}},
                    Wrong{"SizeTail", "size", "10x10x10", {"--size"}},
                    Wrong{"Samples", "samples", "2", {"--samples", "1 or 4"}},
                    Wrong{"ColourMap", "colour-map", "jet", {"--colour-map", "red-blue, viridis"}},
                    Wrong{"Range", "range", "1", {"--range", "MIN:MAX"}},
                    Wrong{"RangeTurned", "range", "2:1", {"--range", "MIN below MAX"}},
                    Wrong{"RangeEmpty", "range", "1:1", {"--range"}},
                    Wrong{"RangeOpen", "range", ":", {"--range"}},
                    Wrong{"RangeInfinite", "range", "0:inf", {"--range"}},
                    Wrong{"Spacing", "spacing", "-1", {"--spacing", "0 for none"}},
                    Wrong{"SpacingNan", "spacing", "nan", {"--spacing"}},
                    Wrong{"Light", "light", "sun", {"--light", "three-point, headlight, none"}},
                    Wrong{"Background", "background", "red", {"--background", "light, dark"}},
                    Wrong{"Azimuth", "azimuth", "north", {"--azimuth", "degrees"}},
                    Wrong{"AzimuthNan", "azimuth", "nan", {"--azimuth"}},
                    Wrong{"Elevation", "elevation", "91", {"--elevation", "-90", "to 90"}},
                    Wrong{"Zoom", "zoom", "0", {"--zoom", "0.001"}},
                    Wrong{"Pan", "pan", "1", {"--pan", "RIGHT:UP"}},
                    Wrong{"PanText", "pan", "1:up", {"--pan"}},
                    Wrong{"Fit", "fit", "loose", {"--fit", "tight, sphere"}},
                    Wrong{"Projection", "projection", "fisheye", {"--projection", "orthographic"}},
                    Wrong{"Slice", "slice", "w", {"--slice", "NX:NY:NZ", "off"}},
                    Wrong{"SliceZero", "slice", "0:0:0", {"--slice", "1:1:0"}},
                    Wrong{"SliceNan", "slice", "1:nan:0", {"--slice"}},
                    Wrong{"SliceAt", "slice-at", "1.5", {"--slice-at", "0 to 1"}},
                    Wrong{"Peel", "peel", "near:0.5", {"--peel", "below:SHARE", "above:SHARE"}},
                    Wrong{"PeelOff", "peel", "off:0.5", {"--peel"}},
                    Wrong{"PeelShare", "peel", "below:2", {"--peel", "0 to 1"}},
                    Wrong{"Turntable", "turntable", "0", {"--turntable", "1 to 3600"}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace geotherm::test
