// SPDX-License-Identifier: MIT
#include "app/picture/picture_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/option_value.h"
#include "app/picture/picture_text.h"
#include "app/picture/picture_values.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

constexpr int kMostFrames = 3600;

Result<std::string> colour_map_in(const std::string& text,
                                  std::span<const std::string> colour_maps) {
  if (text.empty() && !colour_maps.empty()) return colour_maps.front();
  if (std::find(colour_maps.begin(), colour_maps.end(), text) != colour_maps.end()) return text;
  return Error{ErrorCode::kBadInput,
               "there is no colour map '" + one_line(text) + "'; there are " + joined(colour_maps)};
}

Result<CameraSettings> camera_in(const PictureArguments& a, bool turns) {
  CameraSettings camera;
  camera.fit = turns ? PictureFit::kSphere : PictureFit::kTight;
  Pan pan;
  const Result<void> all = first_failure({
      take(parse_azimuth(a.azimuth), "--azimuth", camera.azimuth),
      take(parse_elevation(a.elevation), "--elevation", camera.elevation),
      take(parse_zoom(a.zoom), "--zoom", camera.zoom),
      take(parse_pan(a.pan), "--pan", pan),
      take(parse_projection(a.projection), "--projection", camera.orthographic),
      a.fit.empty() ? Result<void>() : take(parse_fit(a.fit), "--fit", camera.fit),
      take(parse_centre(a.centre), "--centre", camera.centre),
  });
  if (!all) return all.error();
  if (camera.centre && a.fit.empty()) camera.fit = PictureFit::kSphere;
  if (camera.centre && camera.fit == PictureFit::kTight) {
    return Error{ErrorCode::kBadInput,
                 "--centre: a tight fit decides itself what is in the middle; give --fit sphere"};
  }
  camera.pan_right = pan.right;
  camera.pan_up = pan.up;
  return camera;
}

}  // namespace

void add_picture_options(CLI::App& command, PictureArguments& a) {
  const auto add = [&command](const char* names, std::string& value, const char* type,
                              const std::string& help, const char* group) {
    command.add_option(names, value, help)->type_name(type)->group(group);
  };
  const auto add_flag = [&command](const char* names, bool& value, const char* help) {
    command.add_flag(names, value, help)->group("Picture");
  };
  add("--view", a.view, "VIEW", joined(view_names()), "Picture");
  add("--size", a.size, "WxH", "pixels, up to 8192x8192, default 1280x720", "Picture");
  add("--samples", a.samples, "N", "a pixel: 4 (default) or 1", "Picture");
  add("--colour-map,--colormap", a.colour_map, "NAME", "colours of the distances", "Picture");
  add_flag("--reverse", a.reverse, "turn the colour map round");
  add("--range", a.range, "MIN:MAX",
      "distances at the ends of the colour map, default 0 to the largest", "Picture");
  add("--spacing", a.spacing, "D",
      "between isolines in model units, default a round number; 0: no isolines", "Picture");
  add("--light", a.light, "NAME", joined(light_names()), "Picture");
  add("--background", a.background, "NAME", joined(background_names()), "Picture");
  add_flag("--no-bar", a.no_bar, "no colour bar");
  add_flag("--no-caption", a.no_caption, "no line about model, t and backend");
  add_flag("--no-markers", a.no_markers, "sources are not marked");
  add("--device", a.device, "NAME", "part of a device's name (geotherm devices)", "Picture");
  add("--azimuth", a.azimuth, "DEGREES", "of the eye about the vertical axis, default 30",
      "Camera");
  add("--elevation", a.elevation, "DEGREES", "of the eye, default 20", "Camera");
  add("--zoom", a.zoom, "FACTOR", "default 1: as large as it fits", "Camera");
  add("--pan", a.pan, "RIGHT:UP", "shift in picture heights", "Camera");
  add("--centre,--center", a.centre, "X:Y:Z",
      "what is in the middle, in model units, and what turntables turn about; implies --fit sphere",
      "Camera");
  add("--fit", a.fit, "HOW",
      "tight (default): as large as it can be from here; sphere: the same size from everywhere",
      "Camera");
  add("--projection", a.projection, "NAME", "perspective (default), orthographic", "Camera");
  add("--turntable", a.turntable, "N",
      "N pictures of one turn, numbered from 000 before the extension", "Camera");
}

void complete_bare_fit(std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "--fit") continue;
    if (i + 1 == words.size() || !parse_fit(words[i + 1])) words[i] = "--fit=tight";
  }
}

Result<PictureSettings> picture_settings(const PictureArguments& a,
                                         std::span<const std::string> colour_maps) {
  PictureSettings s;
  Size size;
  Range range;
  const Result<void> all = first_failure({
      take(parse_view(a.view), "--view", s.view),
      take(parse_size(a.size), "--size", size),
      take(parse_samples(a.samples), "--samples", s.samples),
      take(colour_map_in(a.colour_map, colour_maps), "--colour-map", s.colour_map),
      take(parse_range(a.range), "--range", range),
      take(parse_spacing(a.spacing), "--spacing", s.line_spacing),
      take(parse_light(a.light), "--light", s.light),
      take(parse_background(a.background), "--background", s.background),
      a.turntable.empty() ? Result<void>()
                          : take(whole_between(a.turntable, 1, kMostFrames,
                                               "is no number of pictures; give 1 to " +
                                                   std::to_string(kMostFrames)),
                                 "--turntable", s.turntable),
  });
  if (!all) return all.error();
  const auto camera = camera_in(a, !a.turntable.empty());
  if (!camera) return camera.error();
  s.camera = *camera;
  s.width = size.width;
  s.height = size.height;
  s.range_min = range.min;
  s.range_max = range.max;
  s.reverse = a.reverse;
  s.bar = !a.no_bar;
  s.caption = !a.no_caption;
  s.markers = !a.no_markers;
  s.device = a.device;
  return s;
}

}  // namespace geotherm::app
