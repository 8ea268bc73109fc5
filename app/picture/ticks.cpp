// SPDX-License-Identifier: MIT
// Round numbers, and marks on scales.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/picture/picture_scale.h"
#include "app/text/text.h"

namespace geotherm::app {
namespace {

constexpr std::array kMantissas = {"1", "2", "2.5", "5"};
constexpr double kBands = 20;
/// Shares of a step that rounding may take from a tick at the end of its range.
constexpr double kSlack = 1e-6;
/// Labels from here on are written with a power of ten.
constexpr int kLargePower = 6;
constexpr int kSmallPower = -4;
constexpr int kMaxDecimals = 12;

/// m * 10^power as the double next to it, which a product would miss.
double decimal(const char* mantissa, int power) {
  return number_in<double>(mantissa + ("e" + std::to_string(power))).value_or(0);
}

/// The power of ten of x's first digit; right for numbers near the ends of the range too.
int power_of(double x) { return static_cast<int>(std::floor(std::log10(x))); }

/// All round numbers about x, ascending.
std::vector<double> round_numbers_about(double x) {
  std::vector<double> out;
  const int power = power_of(x);
  for (int p = power - 1; p <= power + 1; ++p) {
    for (const char* mantissa : kMantissas) {
      const double value = decimal(mantissa, p);
      if (value > 0) out.push_back(value);
    }
  }
  return out;
}

/// Decimals that show multiples of `step` without rounding.
int decimals_of(double step) {
  for (int decimals = 0; decimals < kMaxDecimals; ++decimals) {
    const double scaled = step * std::pow(10.0, decimals);
    if (scaled >= 0.5 && std::abs(scaled - std::round(scaled)) <= kSlack * scaled) return decimals;
  }
  return kMaxDecimals;
}

void add_labels(Ticks& ticks) {
  double largest = 0;
  for (const double value : ticks.values) largest = std::max(largest, std::abs(value));
  int power = largest > 0 ? power_of(largest * (1 + kSlack)) : 0;
  if (power < kLargePower && power >= kSmallPower) power = 0;
  // In two factors: 10^-power alone may lie outside the range of doubles.
  const auto scaled = [power](double value) {
    const int half = power / 2;
    return value * std::pow(10.0, -half) * std::pow(10.0, half - power);
  };
  const int decimals = decimals_of(scaled(ticks.step));
  for (const double value : ticks.values) {
    std::string label = value == 0 ? "0" : fixed(scaled(value), decimals);
    if (power != 0 && value != 0) label += "e" + std::to_string(power);
    ticks.labels.push_back(std::move(label));
  }
}

/// How many multiples of `step` lie in the range.
double count_of(double min, double max, double step) {
  return std::floor(max / step + kSlack) - std::ceil(min / step - kSlack) + 1;
}

/// The smallest multiple of the spacing with at most `most` ticks, round where the spacing is.
double multiple_of(double spacing, double min, double max, int most) {
  const auto is_round = [](double x) {
    return std::abs(nearest_round_number(x) - x) <= kSlack * x;
  };
  double ten = 1;
  for (int power = 0; power < 4; ++power, ten *= 10) {
    for (const double digit : {1.0, 2.0, 4.0, 5.0}) {
      const double step = digit * ten * spacing;
      if (is_round(spacing) && !is_round(step)) continue;
      if (count_of(min, max, step) <= most)
        return is_round(step) ? nearest_round_number(step) : step;
    }
  }
  return 0;
}

}  // namespace

double nearest_round_number(double x) {
  double best = 0;
  double least = 0;
  for (const double value : round_numbers_about(x)) {
    const double away = std::abs(std::log(value / x));
    if (best > 0 && away >= least) continue;
    best = value;
    least = away;
  }
  return best > 0 ? best : x;
}

double round_number_above(double x) {
  for (const double value : round_numbers_about(x)) {
    if (value >= x * (1 - kSlack)) return value;
  }
  return x;
}

double round_spacing(double range) {
  if (!(range > 0) || !std::isfinite(range)) return 1;
  const double spacing = nearest_round_number(range / kBands);
  return spacing > 0 ? spacing : range;
}

namespace {

/// Powers of ten and, where these are few, 2 and 5 times those.
std::vector<double> round_numbers_between(double min, double max) {
  std::vector<double> powers, all;
  for (int p = power_of(min) - 1; p <= power_of(max) + 1; ++p) {
    for (const char* mantissa : {"1", "2", "5"}) {
      const double value = decimal(mantissa, p);
      if (value < min * (1 - kSlack) || value > max * (1 + kSlack)) continue;
      all.push_back(value);
      if (*mantissa == '1') powers.push_back(value);
    }
  }
  constexpr std::size_t kFew = 3;
  return powers.size() > kFew ? powers : all;
}

/// 1.2 x 10^3 as "1.2e3".
std::string scientific(double value, int digits) {
  const double size = std::abs(value);
  int power = size > 0 ? power_of(size) : 0;
  const auto mantissa = [&] { return fixed(value * std::pow(10.0, -power), digits); };
  if (mantissa().find("10") == (value < 0 ? 1U : 0U)) ++power;  // 9.99 is 10.0 with one digit
  return mantissa() + "e" + std::to_string(power);
}

}  // namespace

double band_width(double range, int bands) {
  const double least = range / bands;
  if (!(least > 0) || !std::isfinite(least)) return 1;
  const int power = power_of(least);
  for (const int p : {power, power + 1}) {
    for (const char* mantissa : {"1", "1.2", "1.5", "2", "2.5", "3", "4", "5", "6", "8"}) {
      if (decimal(mantissa, p) >= least * (1 - kSlack)) return decimal(mantissa, p);
    }
  }
  return least;
}

Ticks make_log_ticks(double min, double max, int most) {
  std::vector<double> values = round_numbers_between(min, max);
  const auto room = static_cast<std::size_t>(std::max(most, 2));
  if (values.size() > room) {  // the ends, and powers of ten between them
    const double first = values.front(), last = values.back();
    std::erase_if(values, [&](double x) {
      const bool is_power = std::abs(std::remainder(std::log10(x), 1.0)) < kSlack;
      return x != first && x != last && !is_power;
    });
  }
  Ticks ticks;
  const std::size_t each = (values.size() + room - 1) / room;
  for (std::size_t i = values.size(); i > 0; i -= std::min(i, each)) {  // from the larger end
    ticks.values.insert(ticks.values.begin(), values[i - 1]);
    ticks.labels.insert(ticks.labels.begin(), significant(values[i - 1]));
  }
  return ticks;
}

std::vector<double> log_levels(double min, double max, std::size_t most) {
  std::vector<double> levels = round_numbers_between(min, max);
  while (levels.size() > most) levels.erase(levels.begin());
  return levels;
}

Ticks make_band_ticks(double min, double max, int bands, int most) {
  int each = 1;
  while (bands % each != 0 || bands / each > most) ++each;
  Ticks ticks;
  ticks.step = (max - min) / bands * each;
  for (int i = 0; i <= bands; i += each) {
    const double value = min + (max - min) * i / bands;
    ticks.values.push_back(std::abs(value) < kSlack * ticks.step ? 0 : value);
  }
  const double power = std::pow(10.0, power_of(ticks.step));
  if (decimals_of(ticks.step / power) <= 3) {
    add_labels(ticks);
    return ticks;
  }
  for (const double value : ticks.values) ticks.labels.push_back(significant(value, 3));
  return ticks;
}

void format_labels(Ticks& ticks, const NumberFormat& format) {
  if (format.style == NumberStyle::kAuto) return;
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double value = ticks.values[i];
    std::string& label = ticks.labels[i];
    switch (format.style) {
      case NumberStyle::kFixed:
        label = fixed(value, format.digits);
        break;
      case NumberStyle::kScientific:
        label = scientific(value, format.digits);
        break;
      default:
        label = significant(value, format.digits);
    }
  }
}

Ticks make_ticks(double min, double max, int most, double spacing) {
  Ticks ticks;
  if (!(max > min) || !std::isfinite(max - min)) return ticks;
  if (spacing > 0) ticks.step = multiple_of(spacing, min, max, most);
  if (!(ticks.step > 0) || count_of(min, max, ticks.step) < 2) {
    ticks.step = round_number_above((max - min) / most);
    while (count_of(min, max, ticks.step) > most) {
      ticks.step = round_number_above(ticks.step * 1.5);
    }
  }
  const double first = std::ceil(min / ticks.step - kSlack);
  const int count = static_cast<int>(count_of(min, max, ticks.step));
  for (int i = 0; i < count; ++i) {
    const double value = (first + i) * ticks.step;
    ticks.values.push_back(value == 0 ? 0.0 : value);
  }
  add_labels(ticks);
  return ticks;
}

}  // namespace geotherm::app
