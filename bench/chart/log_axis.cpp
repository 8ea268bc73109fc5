// SPDX-License-Identifier: MIT
#include "bench/chart/log_axis.h"

#include <algorithm>
#include <cmath>

namespace geotherm::bench {
namespace {

/// Rounding of powers must not lose a tick at an end.
constexpr double kSlack = 1e-9;

/// The next of 1, 2 and 5 times the powers of ten, downwards or upwards.
double round_number(double value, bool up) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  double best = up ? 10 * power : power;
  for (const double step : {1.0, 2.0, 5.0}) {
    const double candidate = step * power;
    if (up && candidate >= value * (1 - kSlack)) return candidate;
    if (!up && candidate <= value * (1 + kSlack)) best = candidate;
  }
  return best;
}

std::vector<double> multiples(std::vector<double> steps, double low, double high) {
  std::vector<double> out;
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  for (int d = static_cast<int>(std::floor(std::log10(low))); d <= last; ++d) {
    for (const double step : steps) {
      const double tick = step * std::pow(10.0, d);
      if (tick >= low * (1 - kSlack) && tick <= high * (1 + kSlack)) out.push_back(tick);
    }
  }
  return out;
}

}  // namespace

void LogAxis::include(double value) {
  if (!(value > 0) || !std::isfinite(value)) return;
  low_ = std::min(low_, value);
  high_ = std::max(high_, value);
}

void LogAxis::round_outwards() {
  if (empty()) return;
  low_ = round_number(low_, false);
  high_ = round_number(high_, true);
  while (high_ < 10 * low_ * (1 - kSlack)) {
    low_ = round_number(low_ * 0.99, false);
    high_ = round_number(high_ * 1.01, true);
  }
}

void LogAxis::pad(double share) {
  if (empty()) return;
  const double factor = high_ > low_ ? std::pow(high_ / low_, share) : 2;
  low_ /= factor;
  high_ *= factor;
}

double LogAxis::at(double value) const {
  return from_ + (to_ - from_) * std::log(value / low_) / std::log(high_ / low_);
}

std::vector<double> LogAxis::ticks() const {
  if (empty()) return {};
  const double decades = std::log10(high_ / low_);
  if (decades < 1.6) return multiples({1, 2, 5}, low_, high_);
  return multiples(decades < 3.2 ? std::vector{1.0, 3.0} : std::vector{1.0}, low_, high_);
}

}  // namespace geotherm::bench
