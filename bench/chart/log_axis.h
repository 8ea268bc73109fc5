// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace geotherm::bench {

/// A logarithmic axis of a chart, from values to pixels.
class LogAxis {
 public:
  /// Room for whatever is included later.
  LogAxis(double from, double to) : from_(from), to_(to) {}

  /// Stretches the range. What is not a positive finite number is left out.
  void include(double value);

  /// Nothing was included: there is no place for anything.
  bool empty() const { return !(low_ <= high_); }

  /// Rounds the range outwards to 1, 2 or 5 times a power of ten, and keeps a factor of ten at
  /// least in it. Call before at() and ticks().
  void round_outwards();

  /// Widens the range by this share of its length at each end.
  void pad(double share);

  /// The pixel of a value. Preconditions: !empty(), value > 0.
  double at(double value) const;

  /// Values to write at the axis, ascending: the powers of ten, and between them 3 or 2 and 5 times
  /// those where they are few.
  std::vector<double> ticks() const;

 private:
  double from_, to_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = 0;
};

}  // namespace geotherm::bench
