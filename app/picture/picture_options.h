// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli_app.h"
#include "app/picture/picture_settings.h"
#include "solver/core/result.h"

namespace geotherm::app {

/// How a picture is to look, as typed; the same in every command that draws.
struct PictureArguments {
  std::string view = "contours";
  std::string size = "1280x720";
  std::string samples = "4";
  std::string colour_map;  ///< empty: the first there is
  bool reverse = false;
  std::string range, spacing;  ///< empty: by the data
  std::string light = "three-point";
  std::string background = "light";
  bool no_bar = false, no_caption = false, no_markers = false;
  std::string azimuth = "30", elevation = "20", zoom = "1", pan = "0:0";
  std::string centre;  ///< empty: the middle of the model
  std::string fit;     ///< empty: tight, or sphere for a turntable
  std::string projection = "perspective";
  std::string turntable;  ///< empty: one picture
  std::string device;
};

void add_picture_options(CLI::App& command, PictureArguments& arguments);

/// `--fit` may stand alone, and CLI11 would then take the next word for its value: a bare one
/// becomes `--fit=tight`.
void complete_bare_fit(std::vector<std::string>& words);

/// `colour_maps`: the names there are, the default first. Errors: kBadInput, with the option's
/// name, the value and what is expected.
Result<PictureSettings> picture_settings(const PictureArguments& arguments,
                                         std::span<const std::string> colour_maps);

}  // namespace geotherm::app
