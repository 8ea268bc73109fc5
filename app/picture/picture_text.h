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

/// "1280x720" or "8cmx6cm".
std::string size_text(const PictureSize& size);
std::string size_text(const PictureSettings& settings);

/// "1.5" (pixels), "0.5pt" or, without one, "auto".
std::string length_text(const std::optional<PaperLength>& length);

/// "auto", "fixed:2".
std::string number_format_text(const NumberFormat& format);

/// "0.5,1,2" or, without any, "auto".
std::string values_text(const std::vector<double>& values);

struct Range {
  std::optional<double> min, max;
};
struct Pan {
  double right = 0, up = 0;
};

Result<PictureSize> parse_size(const std::string& text);                   // 1280x720 | 8cmx6cm
Result<std::optional<PaperLength>> parse_length(const std::string& text);  // 1.5 | 0.5pt | auto
Result<std::optional<int>> parse_dpi(const std::string& text);             // 10 to 2400 | auto
Result<NumberFormat> parse_number_format(const std::string& text);         // auto | fixed:2
Result<std::vector<double>> parse_values(const std::string& text);         // V1,V2,... | auto
Result<int> parse_bands(const std::string& text);                          // 2 to 64 | off
Result<double> parse_roll(const std::string& text);                        // degrees
Result<int> parse_samples(const std::string& text);                        // 1 | 4
Result<Range> parse_range(const std::string& text);                        // MIN:MAX | MIN: | auto
Result<std::optional<double>> parse_spacing(const std::string& text);      // D | auto
Result<double> parse_azimuth(const std::string& text);                     // degrees
Result<double> parse_elevation(const std::string& text);                   // degrees
Result<double> parse_zoom(const std::string& text);                        // factor
Result<Pan> parse_pan(const std::string& text);                            // RIGHT:UP
Result<bool> parse_projection(const std::string& text);                    // true: orthographic
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
inline constexpr int kMaxBands = 64;
inline constexpr std::size_t kMaxLineValues = 64;

}  // namespace geotherm::app
