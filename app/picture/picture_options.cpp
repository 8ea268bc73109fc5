// SPDX-License-Identifier: MIT
#include "app/picture/picture_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/picture/picture_text.h"
#include "app/text.h"
#include "app/told.h"

namespace geotherm::app {
namespace {

constexpr int kMaxFrames = 3600;

Result<void> choose_colour_map(bool typed, std::span<const std::string> colour_maps,
                               std::string& chosen) {
  if (!typed && !colour_maps.empty()) chosen = colour_maps.front();
  if (std::ranges::count(colour_maps, chosen) > 0) return {};
  return Error{ErrorCode::kBadInput, "--colour-map: there is no colour map '" + one_line(chosen) +
                                         "'; there are " + joined(colour_maps)};
}

/// What fits where nobody said: a sphere where the model turns or its middle is given.
Result<void> choose_fit(bool typed, const PictureSettings& picture, CameraSettings& camera) {
  if (!typed) {
    const bool sphere = picture.turntable > 0 || camera.centre;
    camera.fit = sphere ? PictureFit::kSphere : PictureFit::kTight;
  }
  if (!camera.centre || camera.fit != PictureFit::kTight) return {};
  return Error{ErrorCode::kBadInput,
               "--centre: a tight fit decides itself what is in the middle; give --fit sphere"};
}

}  // namespace

void add_picture_options(CLI::App& command, SettingArguments& settings, PictureArguments& a) {
  add_setting_options(command, settings, names_of(SettingGroup::kPicture));
  command.add_option("--device", a.device, "part of a device's name (geotherm devices)")
      ->type_name("NAME")
      ->group("Picture");
  add_setting_options(command, settings, names_of(SettingGroup::kCamera));
  command
      .add_option("--turntable", a.turntable,
                  "N pictures of one turn, numbered from 000 before the extension")
      ->type_name("N")
      ->group("Camera");
}

void add_line_picture_options(CLI::App& command, SettingArguments& settings) {
  add_setting_options(command, settings,
                      {"size", "background", "azimuth", "elevation", "zoom", "pan", "projection"});
}

void complete_bare_fit(std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != "--fit") continue;
    if (i + 1 == words.size() || !parse_fit(words[i + 1])) words[i] = "--fit=tight";
  }
}

Result<PictureSettings> picture_settings(const ViewerState& asked, const SettingArguments& typed,
                                         const PictureArguments& a,
                                         std::span<const std::string> colour_maps) {
  PictureSettings picture = asked.picture;
  const bool typed_map = typed.has("colour-map");
  if (auto map = choose_colour_map(typed_map, colour_maps, picture.colour_map); !map) {
    return map.error();
  }
  if (!a.turntable.empty()) {
    const auto frames =
        whole_between(a.turntable, 1, kMaxFrames,
                      "is no number of pictures; give 1 to " + std::to_string(kMaxFrames));
    if (!frames) return about("--turntable", frames.error());
    picture.turntable = *frames;
  }
  if (auto fit = choose_fit(typed.has("fit"), picture, picture.camera); !fit) return fit.error();
  picture.device = a.device;
  return picture;
}

}  // namespace geotherm::app
