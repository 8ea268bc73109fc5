// SPDX-License-Identifier: MIT
// The settings of pictures and of the camera.
#include <algorithm>

#include "app/picture/picture_text.h"
#include "app/session/settings.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

using Names = std::vector<std::string>;
using State = ViewerState;
using Text = std::string;
using enum SettingGroup;
using enum SettingKind;

Result<void> set_range(State& s, const Text& text) {
  const auto range = parse_range(text);
  if (!range) return range.error();
  s.picture.range_min = range->min;
  s.picture.range_max = range->max;
  return {};
}

Result<void> set_picture_size(State& s, const Text& text) {
  const auto size = parse_size(text);
  return size ? set_size(s.picture, *size) : size.error();
}

Result<void> set_pan(State& s, const Text& text) {
  const auto pan = parse_pan(text);
  if (!pan) return pan.error();
  s.picture.camera.pan_right = pan->right;
  s.picture.camera.pan_up = pan->up;
  return {};
}

/// The renderer knows the names of the maps; any name is accepted here.
Result<void> set_colour_map(State& s, const Text& text) {
  const bool is_name = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
  if (!is_name) return Error{ErrorCode::kBadInput, "'" + one_line(text) + "' is no colour map"};
  s.picture.colour_map = text;
  return {};
}

/// A switch of the picture; `bare`: what its option stands for.
template <auto kMember>
Setting picture_switch(std::string_view name, std::string_view option, std::string_view bare,
                       std::string_view help) {
  return {
      .name = name,
      .group = kPicture,
      .kind = kSwitch,
      .option = option,
      .bare = bare,
      .help = help,
      .get = [](const State& s) { return switch_text(member_of(s, kMember)); },
      .set = [](State& s, const Text& t) { return store(parse_switch(t), member_of(s, kMember)); }};
}

}  // namespace

std::vector<Setting> picture_settings_table() {
  return {
      choice<&PictureSettings::view>({.name = "view",
                                      .group = kPicture,
                                      .usual = true,
                                      .value_name = "VIEW",
                                      .help = "what is shown"}),
      {.name = "size",
       .group = kPicture,
       .value_name = "WxH",
       .help = "size of the picture, in pixels, up to 8192x8192, or in cm, mm, in or pt, such as "
               "8cmx6cm",
       .get = [](const State& s) { return size_text(s.picture); },
       .set = set_picture_size},
      number<&PictureSettings::samples, parse_samples>({.name = "samples",
                                                        .group = kPicture,
                                                        .value_name = "N",
                                                        .help = "samples a pixel",
                                                        .detail = "4: smooth edges; 1: faster.",
                                                        .values =
                                                            [] {
                                                              return Names{"1", "4"};
                                                            }}),
      {.name = "colour-map",
       .group = kPicture,
       .usual = true,
       .option = "--colour-map,--colormap",
       .value_name = "NAME",
       .help = "colours of the distances",
       .get = [](const State& s) { return s.picture.colour_map; },
       .set = set_colour_map},
      picture_switch<&PictureSettings::reverse>("reverse", "", "on",
                                                "the colour map is turned round"),
      {.name = "range",
       .group = kPicture,
       .value_name = "MIN:MAX",
       .help = "distances at the ends of the colour map; auto: 0 to the largest",
       .get = [](const State& s) { return range_text(s.picture); },
       .set = set_range},
      {.name = "spacing",
       .group = kPicture,
       .usual = true,
       .value_name = "D",
       .help = "distance between isolines in model units; 0: none; auto: a round number",
       .get =
           [](const State& s) {
             return s.picture.line_spacing ? number_text(*s.picture.line_spacing) : Text("auto");
           },
       .set = [](State& s,
                 const Text& t) { return store(parse_spacing(t), s.picture.line_spacing); }},
      choice<&PictureSettings::light>({.name = "light",
                                       .group = kPicture,
                                       .value_name = "NAME",
                                       .help = "light on the surface"}),
      choice<&PictureSettings::shading>(
          {.name = "shading",
           .group = kPicture,
           .value_name = "NAME",
           .help = "form: darker in hollows and towards outlines; plain: by the light alone"}),
      choice<&PictureSettings::background>({.name = "background",
                                            .group = kPicture,
                                            .usual = true,
                                            .value_name = "NAME",
                                            .help = "background of the picture"}),
      picture_switch<&PictureSettings::bar>("bar", "--no-bar", "off", "the colour bar"),
      picture_switch<&PictureSettings::caption>("caption", "--no-caption", "off",
                                                "the line about model, t and backend"),
      picture_switch<&PictureSettings::markers>("markers", "--no-markers", "off",
                                                "marks where the sources are"),
      {.name = "slice",
       .group = kPicture,
       .usual = true,
       .value_name = "NORMAL",
       .help = "removes what lies on this side of a plane, so that one sees into a volume; also "
               "NX:NY:NZ",
       .detail = "A surface is cut open, and nothing fills the opening.",
       .get = [](const State& s) { return slice_text(s.picture); },
       .set = [](State& s, const Text& t) { return store(parse_slice(t), s.picture.slice); },
       .values = [] { return Names{"off", "x", "y", "z", "-x", "-y", "-z"}; }},
      number<&PictureSettings::slice_at, parse_slice_at>(
          {.name = "slice-at",
           .group = kPicture,
           .value_name = "SHARE",
           .help =
               "where the plane of the slice is, 0 to 1 of the model's extent along its normal"}),
      {.name = "peel",
       .group = kPicture,
       .value_name = "SIDE[:SHARE]",
       .help =
           "draws only the tets (on a surface, the faces) whose distance is below or above this "
           "share of the largest",
       .forms = "off, below[:SHARE] or above[:SHARE], a share of 0.5 where none is given",
       .detail = "All corners count. Where errors are shown, their size takes the place of the "
                 "distance.",
       .get = [](const State& s) { return peel_text(s.picture.peel); },
       .set = [](State& s, const Text& t) { return store(parse_peel(t), s.picture.peel); },
       .values =
           [] {
             return Names{"off", "below:0.5", "above:0.5"};
           }},
      number<&CameraSettings::azimuth, parse_azimuth>(
          {.name = "azimuth",
           .group = kCamera,
           .value_name = "DEGREES",
           .help = "where the eye is about the vertical axis"}),
      number<&CameraSettings::elevation, parse_elevation>(
          {.name = "elevation",
           .group = kCamera,
           .value_name = "DEGREES",
           .help = "how high the eye is, -90 to 90"}),
      number<&CameraSettings::roll, parse_roll>(
          {.name = "roll",
           .group = kCamera,
           .value_name = "DEGREES",
           .help = "turns the picture about its middle, counter-clockwise"}),
      choice<&CameraSettings::up>({.name = "up",
                                   .group = kCamera,
                                   .value_name = "AXIS",
                                   .help = "the axis that points up",
                                   .detail = "auto: as the model's file says, else y."}),
      number<&CameraSettings::zoom, parse_zoom>({.name = "zoom",
                                                 .group = kCamera,
                                                 .value_name = "FACTOR",
                                                 .help = "1: as large as it fits"}),
      {.name = "pan",
       .group = kCamera,
       .value_name = "RIGHT:UP",
       .help = "shift in picture heights",
       .get =
           [](const State& s) {
             return number_text(s.picture.camera.pan_right) + ":" +
                    number_text(s.picture.camera.pan_up);
           },
       .set = set_pan},
      {.name = "centre",
       .group = kCamera,
       .option = "--centre,--center",
       .value_name = "X:Y:Z",
       .help = "what is in the middle, in model units, and what turntables turn about; implies fit "
               "sphere",
       .get = [](const State& s) { return centre_text(s.picture.camera); },
       .set = [](State& s,
                 const Text& t) { return store(parse_centre(t), s.picture.camera.centre); }},
      choice<&CameraSettings::fit>(
          {.name = "fit",
           .group = kCamera,
           .value_name = "HOW",
           .help = "how the model fills the picture",
           .detail =
               "tight: as large as it can be from here; sphere: the same size from everywhere."}),
      {.name = "projection",
       .group = kCamera,
       .value_name = "NAME",
       .help = "projection of space onto the picture",
       .get =
           [](const State& s) {
             return Text(s.picture.camera.orthographic ? "orthographic" : "perspective");
           },
       .set =
           [](State& s, const Text& t) {
             return store(parse_projection(t), s.picture.camera.orthographic);
           },
       .values =
           [] {
             return Names{"perspective", "orthographic"};
           }},
  };
}

}  // namespace geotherm::app
