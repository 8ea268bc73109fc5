// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/picture/picture_settings.h"
#include "geotherm/error.h"

// A picture's settings as text and back, the same on the command line, in scripts and in panels.
// Errors: kBadInput, with the text and what is expected.
namespace geotherm::app {

/// "0:2.5", one end left out where the data decide it, or "auto" where they decide both.
std::string range_text(const PictureSettings& settings);

/// "0:1.5:-2", or "auto" where the middle of the model is the centre.
std::string centre_text(const CameraSettings& camera);

/// "x", "-y" or "1:0.5:0", or "off" where nothing is sliced.
std::string slice_text(const PictureSettings& settings);

/// "below:0.5", "above:0.5" or "off".
std::string peel_text(const Peel& peel);

struct Size {
  int width = 0, height = 0;
};
struct Range {
  std::optional<double> min, max;
};
struct Pan {
  double right = 0, up = 0;
};

Result<Size> parse_size(const std::string& text);                      // 1280x720
Result<int> parse_samples(const std::string& text);                    // 1 | 4
Result<Range> parse_range(const std::string& text);                    // MIN:MAX | MIN: | auto
Result<std::optional<double>> parse_spacing(const std::string& text);  // D | auto
Result<double> parse_azimuth(const std::string& text);                 // degrees
Result<double> parse_elevation(const std::string& text);               // degrees
Result<double> parse_zoom(const std::string& text);                    // factor
Result<Pan> parse_pan(const std::string& text);                        // RIGHT:UP
Result<bool> parse_projection(const std::string& text);                // true: orthographic
Result<std::optional<std::array<double, 3>>> parse_centre(const std::string& text);  // X:Y:Z | auto
Result<std::optional<std::array<double, 3>>> parse_slice(
    const std::string& text);                            // x | X:Y:Z | off
Result<Peel> parse_peel(const std::string& text);        // below:SHARE | above:SHARE | off
Result<double> parse_slice_at(const std::string& text);  // 0 to 1
Result<bool> parse_switch(const std::string& text);      // on | off
inline std::string switch_text(bool on) { return on ? "on" : "off"; }
Result<int> whole_between(const std::string& text, int least, int most, const std::string& why);

/// Bounds of the camera.
inline constexpr double kMinZoom = 1e-3, kMaxZoom = 1e6;
inline constexpr double kMaxPan = 1e3;    ///< picture heights
inline constexpr double kMaxAngle = 1e6;  ///< degrees
inline constexpr int kLargestPictureSide = 8192;

}  // namespace geotherm::app
