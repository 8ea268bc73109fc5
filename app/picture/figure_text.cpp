// SPDX-License-Identifier: MIT
// What figures of papers need as text and back: sizes on paper, number formats, values of isolines.
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/picture/picture_settings.h"
#include "app/picture/picture_text.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

constexpr int kPaperDpi = 300, kScreenDpi = 96;
constexpr double kLongestLength = 1e4;

/// "8cm", "0.5pt" or, in pixels, "12".
std::optional<PaperLength> length_in(const std::string& text) {
  const std::size_t end = text.find_last_of("0123456789.") + 1;
  const auto value = number_in<double>(text.substr(0, end));
  const std::string unit = text.substr(end);
  const auto known = unit.empty() ? Result<PaperUnit>(PaperUnit::kPixel) : parse<PaperUnit>(unit);
  if (!value || !known || !(*value > 0) || *value > kLongestLength) return std::nullopt;
  return PaperLength{*value, *known};
}

std::string text_of(const PaperLength& length) {
  const bool pixels = length.unit == PaperUnit::kPixel;
  return number_text(length.value) + (pixels ? "" : geotherm::to_text(length.unit));
}

}  // namespace

int dots_per_inch(const PictureSettings& settings) {
  return settings.dpi.value_or(settings.paper ? kPaperDpi : kScreenDpi);
}

std::optional<int> said_dpi(const PictureSettings& settings) {
  if (!settings.dpi && !settings.paper) return std::nullopt;
  return dots_per_inch(settings);
}

double pixels_of(const PaperLength& length, const PictureSettings& settings) {
  const double dots = dots_per_inch(settings);
  switch (length.unit) {
    case PaperUnit::kCentimetre:
      return length.value * dots / 2.54;
    case PaperUnit::kMillimetre:
      return length.value * dots / 25.4;
    case PaperUnit::kInch:
      return length.value * dots;
    case PaperUnit::kPoint:
      return length.value * dots / 72;
    case PaperUnit::kPixel:
      break;
  }
  return length.value;
}

Result<void> fit_to_paper(PictureSettings& settings) {
  if (!settings.paper) return {};
  const auto& [across, down] = *settings.paper;
  const double width = std::round(pixels_of(across, settings));
  const double height = std::round(pixels_of(down, settings));
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestPictureSide) {
    return Error{ErrorCode::kBadInput,
                 size_text(settings) + " at " + std::to_string(dots_per_inch(settings)) +
                     " pixels an inch are " + significant(width, 6) + " x " +
                     significant(height, 6) + " pixels, and a side has 1 to " +
                     std::to_string(kLargestPictureSide),
                 {"give another size or ", SettingHint{"dpi"}}};
  }
  settings.width = static_cast<int>(width);
  settings.height = static_cast<int>(height);
  return {};
}

Result<void> set_size(PictureSettings& settings, const PictureSize& size) {
  const auto& [across, down] = size;
  if (across.unit == PaperUnit::kPixel) {
    settings.width = static_cast<int>(across.value);
    settings.height = static_cast<int>(down.value);
    settings.paper = std::nullopt;
    return {};
  }
  PictureSettings changed = settings;
  changed.paper = size;
  auto fits = fit_to_paper(changed);
  if (fits) settings = std::move(changed);
  return fits;
}

std::string size_text(const PictureSize& size) { return text_of(size[0]) + "x" + text_of(size[1]); }

std::string size_text(const PictureSettings& settings) {
  if (settings.paper) return size_text(*settings.paper);
  return std::to_string(settings.width) + "x" + std::to_string(settings.height);
}

Result<PictureSize> parse_size(const std::string& text) {
  const std::size_t at = std::min(text.find_first_of("xX"), text.size());
  const std::string left = text.substr(0, at);
  const std::string right = at == text.size() ? "" : text.substr(at + 1);
  const auto pixels = [](const std::string& side) {
    const auto count = number_in<int>(side);
    return count && *count >= 1 && *count <= kLargestPictureSide ? count : std::nullopt;
  };
  if (const auto width = pixels(left), height = pixels(right); width && height) {
    return PictureSize{PaperLength{static_cast<double>(*width)},
                       PaperLength{static_cast<double>(*height)}};
  }
  const auto across = length_in(left), down = length_in(right);
  const auto on_paper = [](const auto& side) { return side && side->unit != PaperUnit::kPixel; };
  if (on_paper(across) && on_paper(down)) return PictureSize{*across, *down};
  return bad_value(text, "is no size",
                   "give WxH in pixels, each 1 to " + std::to_string(kLargestPictureSide) +
                       ", such as 1920x1080, or in cm, mm, in or pt, such as 8cmx6cm");
}

std::string length_text(const std::optional<PaperLength>& length) {
  return length ? text_of(*length) : "auto";
}

Result<std::optional<PaperLength>> parse_length(const std::string& text) {
  if (text.empty() || text == "auto") return std::optional<PaperLength>();
  if (const auto length = length_in(text)) return length;
  return bad_value(text, "is no length",
                   "give pixels, such as 1.5, or pt, mm, cm or in, such as 0.5pt, or auto");
}

Result<std::optional<int>> parse_dpi(const std::string& text) {
  if (text.empty() || text == "auto") return std::optional<int>();
  constexpr int kMin = 10, kMax = 2400;
  const auto dots = whole_between(text, kMin, kMax, "is no number of pixels an inch");
  if (!dots) return dots.error();
  return std::optional(*dots);
}

std::string number_format_text(const NumberFormat& format) {
  const std::string style = geotherm::to_text(format.style);
  return format.style == NumberStyle::kAuto ? style : style + ':' + std::to_string(format.digits);
}

Result<NumberFormat> parse_number_format(const std::string& text) {
  if (text.empty() || text == "auto") return NumberFormat{};
  constexpr int kMaxDigits = 12;
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto style = parse<NumberStyle>(text.substr(0, colon));
  const auto digits = colon == text.size() ? std::optional(NumberFormat().digits)
                                           : number_in<int>(text.substr(colon + 1));
  const bool fits = style && *style != NumberStyle::kAuto && digits && *digits <= kMaxDigits;
  if (fits && *digits >= (*style == NumberStyle::kSignificant ? 1 : 0)) {
    return NumberFormat{*style, *digits};
  }
  return bad_value(text, "is no number format",
                   "give fixed:N, scientific:N or significant:N with N digits up to 12, such as "
                   "fixed:2, or auto");
}

std::string values_text(const std::vector<double>& values) {
  if (values.empty()) return "auto";
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(number_text(value));
  return joined(texts, ",");
}

Result<std::vector<double>> parse_values(const std::string& text) {
  std::vector<double> values;
  if (text.empty() || text == "auto") return values;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    const auto value = number_in<double>(trimmed(std::string_view(text).substr(from, end - from)));
    if (!value || !std::isfinite(*value)) {
      return bad_value(text, "is no list of values of isolines",
                       "give numbers between commas, such as 0.5,1,2");
    }
    values.push_back(*value);
    from = end + 1;
  }
  std::ranges::sort(values);
  const auto twice = std::ranges::unique(values);
  values.erase(twice.begin(), twice.end());
  if (values.size() <= kMaxLineValues) return values;
  return Error{ErrorCode::kBadInput,
               std::to_string(values.size()) + " values of isolines are more than " +
                   std::to_string(kMaxLineValues),
               {"give fewer, or a ", SettingHint{"spacing"}}};
}

Result<int> parse_bands(const std::string& text) {
  if (text.empty() || text == "off") return 0;
  return whole_between(text, 2, kMaxBands, "is no number of bands");
}

Result<double> parse_roll(const std::string& text) {
  const auto value = number_in<double>(text);
  if (value && std::abs(*value) <= kMaxAngle) return *value;
  return bad_value(text, "is no angle", "give degrees counter-clockwise, such as 90");
}

}  // namespace geotherm::app
