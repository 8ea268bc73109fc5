// SPDX-License-Identifier: MIT
#include "app/lines/line_picture.h"

#include <CLI/CLI.hpp>

#include "app/option_value.h"
#include "app/picture/picture_text.h"
#include "app/picture/picture_values.h"

namespace geotherm::app {

void add_line_picture_options(CLI::App& command, LinePictureArguments& a) {
  const auto add = [&command](const char* names, std::string& value, const char* type,
                              const char* help) {
    command.add_option(names, value, help)->type_name(type)->group("Picture (.svg)");
  };
  add("--size", a.size, "WxH", "pixels, default 1280x720");
  add("--background", a.background, "NAME", "light (default), dark, transparent");
  add("--azimuth", a.azimuth, "DEGREES", "of the eye about the vertical axis, default 30");
  add("--elevation", a.elevation, "DEGREES", "of the eye, default 20");
  add("--zoom", a.zoom, "FACTOR", "default 1: as large as it fits");
  add("--pan", a.pan, "RIGHT:UP", "shift in picture heights");
  add("--projection", a.projection, "NAME", "perspective (default), orthographic");
}

Result<LinePictureSettings> line_picture_settings(const LinePictureArguments& a) {
  LinePictureSettings s;
  Size size;
  Pan pan;
  const Result<void> all = first_failure({
      take(parse_size(a.size), "--size", size),
      take(parse_background(a.background), "--background", s.background),
      take(parse_azimuth(a.azimuth), "--azimuth", s.camera.azimuth),
      take(parse_elevation(a.elevation), "--elevation", s.camera.elevation),
      take(parse_zoom(a.zoom), "--zoom", s.camera.zoom),
      take(parse_pan(a.pan), "--pan", pan),
      take(parse_projection(a.projection), "--projection", s.camera.orthographic),
  });
  if (!all) return all.error();
  s.width = size.width;
  s.height = size.height;
  s.camera.pan_right = pan.right;
  s.camera.pan_up = pan.up;
  return s;
}

}  // namespace geotherm::app
