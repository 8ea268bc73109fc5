// SPDX-License-Identifier: MIT
#include "app/picture/picture_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/picture/picture_settings.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {

std::string range_text(const PictureSettings& s) {
  const auto end = [](const std::optional<double>& value) {
    return value ? number_text(*value) : std::string();
  };
  return s.range_min || s.range_max ? end(s.range_min) + ":" + end(s.range_max) : "auto";
}

std::string centre_text(const CameraSettings& camera) {
  if (!camera.centre) return "auto";
  const auto& [x, y, z] = *camera.centre;
  return number_text(x) + ":" + number_text(y) + ":" + number_text(z);
}

namespace {

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

}  // namespace

std::string slice_text(const PictureSettings& settings) {
  if (!settings.slice) return "off";
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<double, 3> axis{};
    for (const double side : {1.0, -1.0}) {
      axis[k] = side;
      if (*settings.slice == axis) return (side < 0 ? "-" : "") + std::string(kAxes[k]);
    }
  }
  const auto& [x, y, z] = *settings.slice;
  return number_text(x) + ":" + number_text(y) + ":" + number_text(z);
}

std::string peel_text(const Peel& peel) {
  const std::string side = geotherm::to_text(peel.side);
  return peel.side == PeelSide::kOff ? side : side + ":" + number_text(peel.share);
}

namespace {

Result<double> number_between(const std::string& text, double least, double most,
                              const std::string& why, const std::string& hint) {
  const auto value = number_in<double>(text);
  if (value && *value >= least && *value <= most) return *value;
  return bad_value(text, why, hint);
}

/// The parts before and after the first of `marks`.
std::optional<std::pair<std::string, std::string>> halves(const std::string& text,
                                                          const char* marks) {
  const std::size_t at = text.find_first_of(marks);
  if (at == std::string::npos) return std::nullopt;
  return std::pair{text.substr(0, at), text.substr(at + 1)};
}

}  // namespace

Result<int> whole_between(const std::string& text, int least, int most, const std::string& why) {
  const auto value = number_in<int>(text);
  if (value && *value >= least && *value <= most) return *value;
  return bad_value(text, why, "give " + std::to_string(least) + " to " + std::to_string(most));
}

Result<int> parse_samples(const std::string& text) {
  if (text == "1" || text == "4") return text == "1" ? 1 : 4;
  return bad_value(text, "samples a pixel cannot be had", "give 1 or 4");
}

Result<Range> parse_range(const std::string& text) {
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
  return bad_value(text, "is no range",
                   "give MIN:MAX with MIN below MAX, such as 0:2.5; one of them may be left out");
}

Result<std::optional<double>> parse_spacing(const std::string& text) {
  if (text.empty() || text == "auto") return std::optional<double>();
  const auto value = number_in<double>(text);
  if (value && *value >= 0 && std::isfinite(*value)) return value;
  return bad_value(text, "is no spacing of isolines",
                   "give a length in model units, such as 0.5, or 0 for none");
}

Result<double> parse_azimuth(const std::string& text) {
  return number_between(text, -kMaxAngle, kMaxAngle, "is no angle",
                        "give degrees about the vertical axis, such as 30");
}

Result<double> parse_elevation(const std::string& text) {
  return number_between(text, -90, 90, "is no elevation",
                        "give degrees from -90 (from below) to 90 (from above)");
}

Result<double> parse_zoom(const std::string& text) {
  return number_between(text, kMinZoom, kMaxZoom, "is no zoom",
                        "give 0.001 to 1000000, such as 2: twice as large as it fits");
}

Result<Pan> parse_pan(const std::string& text) {
  if (const auto parts = halves(text, ":, ")) {
    const auto right = number_in<double>(parts->first);
    const auto up = number_in<double>(parts->second);
    const auto fits = [](const std::optional<double>& part) {
      return part && std::abs(*part) <= kMaxPan;
    };
    if (fits(right) && fits(up)) return Pan{*right, *up};
  }
  return bad_value(text, "is no shift", "give RIGHT:UP in picture heights, such as 0.1:-0.25");
}

Result<bool> parse_projection(const std::string& text) {
  if (text == "perspective") return false;
  if (text == "orthographic") return true;
  return Error{ErrorCode::kBadInput,
               "there is no projection '" + one_line(text) + "'",
               {"there are perspective, orthographic"}};
}

namespace {

/// X:Y:Z.
std::optional<std::array<double, 3>> three_numbers(const std::string& text) {
  std::array<double, 3> numbers{};
  std::string rest = text;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? rest.find(':') : rest.size();
    const auto value = number_in<double>(rest.substr(0, end));
    if (end == std::string::npos || !value || !std::isfinite(*value)) return std::nullopt;
    numbers[k] = *value;
    rest.erase(0, k < 2 ? end + 1 : end);
  }
  return numbers;
}

}  // namespace

Result<std::optional<std::array<double, 3>>> parse_centre(const std::string& text) {
  if (text.empty() || text == "auto") return std::optional<std::array<double, 3>>();
  const auto centre = three_numbers(text);
  if (centre) return centre;
  return bad_value(text, "is no point", "give X:Y:Z in model units, such as 0:1.5:-2, or auto");
}

Result<std::optional<std::array<double, 3>>> parse_slice(const std::string& text) {
  if (text.empty() || text == "off") return std::optional<std::array<double, 3>>();
  const bool turned = text.front() == '-';
  for (std::size_t k = 0; k < 3; ++k) {
    if (text.substr(turned ? 1 : 0) != kAxes[k]) continue;
    std::array<double, 3> axis{};
    axis[k] = turned ? -1 : 1;
    return std::optional(axis);
  }
  const auto normal = three_numbers(text);
  if (normal && *normal != std::array<double, 3>{}) return normal;
  return bad_value(text, "is no direction",
                   "give x, y, z, -x, -y, -z or NX:NY:NZ, such as 1:1:0, or off");
}

Result<double> parse_slice_at(const std::string& text) {
  return number_between(text, 0, 1, "is no place of the slice",
                        "give a share of the model's extent, 0 to 1");
}

Result<Peel> parse_peel(const std::string& text) {
  if (text.empty() || text == "off") return Peel{};
  const auto parts = halves(text, ":");
  const auto side = parse<PeelSide>(parts ? parts->first : text);
  const auto share = parts ? number_in<double>(parts->second) : Peel().share;
  if (side && *side != PeelSide::kOff && share && *share >= 0 && *share <= 1) {
    return Peel{*side, *share};
  }
  return bad_value(text, "is no peeling",
                   "give below:SHARE or above:SHARE with a share of the largest distance, 0 to 1, "
                   "such as below:0.5, or off");
}

Result<bool> parse_switch(const std::string& text) {
  if (text == "on") return true;
  if (text == "off") return false;
  return bad_value(text, "is neither on nor off");
}

std::array<std::array<double, 3>, 3> axes_of(UpAxis up) {
  switch (up) {
    case UpAxis::kX:
      return {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    case UpAxis::kMinusX:
      return {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
    case UpAxis::kMinusY:
      return {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    case UpAxis::kZ:
      return {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    case UpAxis::kMinusZ:
      return {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};
    default:
      return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  }
}

int frame_count(const PictureSettings& settings) { return std::max(settings.turntable, 1); }

CameraSettings frame_camera(const PictureSettings& settings, int frame) {
  constexpr double kTurn = 360;
  CameraSettings camera = settings.camera;
  if (settings.turntable == 0) return camera;
  camera.azimuth = std::fmod(camera.azimuth + kTurn * frame / settings.turntable, kTurn);
  if (camera.azimuth < 0) camera.azimuth += kTurn;
  return camera;
}

std::vector<std::string> frame_paths(const std::string& output, const PictureSettings& settings) {
  if (settings.turntable == 0) return {output};
  const std::size_t slash = output.rfind('/');
  const std::size_t point = output.rfind('.');
  const bool has_extension =
      point != std::string::npos && (slash == std::string::npos || point > slash);
  const std::string stem = output.substr(0, has_extension ? point : output.size());
  const std::string extension = output.substr(stem.size());
  const std::size_t digits =
      std::max<std::size_t>(3, std::to_string(settings.turntable - 1).size());
  std::vector<std::string> paths;
  for (int i = 0; i < settings.turntable; ++i) {
    const std::string number = std::to_string(i);
    paths.push_back(stem + '-' + std::string(digits - number.size(), '0') + number + extension);
  }
  return paths;
}

}  // namespace geotherm::app
