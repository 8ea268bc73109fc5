// SPDX-License-Identifier: MIT
#include "app/picture/picture_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/option_value.h"
#include "app/picture/picture_text.h"
#include "app/text.h"

namespace geotherm::app {
namespace {

constexpr int kLargestSide = 8192;
constexpr int kMostFrames = 3600;
constexpr double kLeastZoom = 1e-3;
constexpr double kMostZoom = 1e6;
constexpr double kMostPan = 1e3;  ///< picture heights

Error wrong(const std::string& text, const std::string& why) {
  return {ErrorCode::kBadInput, "'" + one_line(text) + "' " + why};
}

/// A number between two bounds.
Result<double> number_between(const std::string& text, double least, double most,
                              const std::string& why) {
  const auto value = number_in<double>(text);
  if (value && *value >= least && *value <= most) return *value;
  return wrong(text, why);
}

Result<int> whole_between(const std::string& text, int least, int most, const std::string& why) {
  const auto value = number_in<int>(text);
  if (value && *value >= least && *value <= most) return *value;
  return wrong(text, why);
}

/// The parts before and after the first of `marks`.
std::optional<std::pair<std::string, std::string>> halves(const std::string& text,
                                                          const char* marks) {
  const std::size_t at = text.find_first_of(marks);
  if (at == std::string::npos) return std::nullopt;
  return std::pair{text.substr(0, at), text.substr(at + 1)};
}

struct Size {
  int width = 0, height = 0;
};
Result<Size> size_in(const std::string& text) {
  if (const auto parts = halves(text, "xX")) {
    const auto width = number_in<int>(parts->first);
    const auto height = number_in<int>(parts->second);
    const auto fits = [](const std::optional<int>& side) {
      return side && *side >= 1 && *side <= kLargestSide;
    };
    if (fits(width) && fits(height)) return Size{*width, *height};
  }
  return wrong(text, "is no size; give WxH in pixels, each 1 to " + std::to_string(kLargestSide) +
                         ", such as 1920x1080");
}

struct Range {
  std::optional<double> min, max;
};
Result<Range> range_in(const std::string& text) {
  if (text.empty() || text == "auto") return Range{};
  const auto parts = halves(text, ":");
  const auto end = [](const std::string& part, std::optional<double>& value) {
    if (part.empty()) return true;
    value = number_in<double>(part);
    return value && std::isfinite(*value);
  };
  Range range;
  if (parts && end(parts->first, range.min) && end(parts->second, range.max) &&
      (range.min || range.max) && !(range.min && range.max && *range.min >= *range.max)) {
    return range;
  }
  return wrong(text,
               "is no range; give MIN:MAX with MIN below MAX, such as 0:2.5; one of them "
               "may be left out");
}

Result<std::optional<double>> spacing_in(const std::string& text) {
  if (text.empty() || text == "auto") return std::optional<double>();
  const auto value = number_in<double>(text);
  if (value && *value >= 0 && std::isfinite(*value)) return value;
  return wrong(text,
               "is no spacing of isolines; give a length in model units, such as 0.5, or 0 "
               "for none");
}

struct Pan {
  double right = 0, up = 0;
};
Result<Pan> pan_in(const std::string& text) {
  if (const auto parts = halves(text, ":, ")) {
    const auto right = number_in<double>(parts->first);
    const auto up = number_in<double>(parts->second);
    const auto fits = [](const std::optional<double>& part) {
      return part && std::abs(*part) <= kMostPan;
    };
    if (fits(right) && fits(up)) return Pan{*right, *up};
  }
  return wrong(text, "is no shift; give RIGHT:UP in picture heights, such as 0.1:-0.25");
}

Result<bool> orthographic_in(const std::string& text) {
  if (text == "perspective") return false;
  if (text == "orthographic") return true;
  return Error{ErrorCode::kBadInput, "there is no projection '" + one_line(text) +
                                         "'; there are perspective, orthographic"};
}

Result<std::string> colour_map_in(const std::string& text,
                                  std::span<const std::string> colour_maps) {
  if (text.empty() && !colour_maps.empty()) return colour_maps.front();
  if (std::find(colour_maps.begin(), colour_maps.end(), text) != colour_maps.end()) return text;
  return Error{ErrorCode::kBadInput,
               "there is no colour map '" + one_line(text) + "'; there are " + joined(colour_maps)};
}

Result<CameraSettings> camera_in(const PictureArguments& a, bool turns) {
  constexpr double kAnyAngle = 1e6;
  CameraSettings camera;
  camera.fit = turns ? PictureFit::kSphere : PictureFit::kTight;
  Pan pan;
  const Result<void> all = first_failure({
      take(number_between(a.azimuth, -kAnyAngle, kAnyAngle,
                          "is no angle; give degrees about the vertical axis, such as 30"),
           "--azimuth", camera.azimuth),
      take(number_between(a.elevation, -90, 90,
                          "is no elevation; give degrees from -90 (from below) to 90 (from above)"),
           "--elevation", camera.elevation),
      take(
          number_between(a.zoom, kLeastZoom, kMostZoom,
                         "is no zoom; give 0.001 to 1000000, such as 2: twice as large as it fits"),
          "--zoom", camera.zoom),
      take(pan_in(a.pan), "--pan", pan),
      take(orthographic_in(a.projection), "--projection", camera.orthographic),
      a.fit.empty() ? Result<void>() : take(parse_fit(a.fit), "--fit", camera.fit),
  });
  if (!all) return all.error();
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
  const auto samples = [](const std::string& text) -> Result<int> {
    if (text == "1" || text == "4") return text == "1" ? 1 : 4;
    return wrong(text, "samples a pixel cannot be had; give 1 or 4");
  };
  const Result<void> all = first_failure({
      take(parse_view(a.view), "--view", s.view),
      take(size_in(a.size), "--size", size),
      take(samples(a.samples), "--samples", s.samples),
      take(colour_map_in(a.colour_map, colour_maps), "--colour-map", s.colour_map),
      take(range_in(a.range), "--range", range),
      take(spacing_in(a.spacing), "--spacing", s.line_spacing),
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
