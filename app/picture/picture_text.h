// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/picture/picture_settings.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// The text form of each choice, the same on the command line, in files and in panels.
/// parse(to_text(x)) == x. Errors: kBadInput, with the values there are.
std::string to_text(View view);                     // wireframe | ... | gradient-error | contours
std::string to_text(PictureLight light);            // three-point | headlight | none
std::string to_text(PictureBackground background);  // light | dark | transparent
std::string to_text(PictureFit fit);                // tight | sphere

Result<View> parse_view(std::string_view text);
Result<PictureLight> parse_light(std::string_view text);
Result<PictureBackground> parse_background(std::string_view text);
Result<PictureFit> parse_fit(std::string_view text);

/// The names of all values, the default first.
std::vector<std::string> view_names();
std::vector<std::string> light_names();
std::vector<std::string> background_names();
std::vector<std::string> fit_names();

/// "0:2.5", one end left out where the data decide it, or "auto" where they decide both.
std::string range_text(const PictureSettings& settings);

/// "0:1.5:-2", or "auto" where the middle of the model is the centre.
std::string centre_text(const CameraSettings& camera);

/// Every setting as name and text, named as its option: ("view", "contours"), ("size", "1280x720").
/// What is chosen by the data ("auto") and flags ("yes", "no") are said as well.
std::vector<std::pair<std::string, std::string>> settings_in_words(const PictureSettings& settings);

}  // namespace geotherm::app
