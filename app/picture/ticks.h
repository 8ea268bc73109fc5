// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace geotherm::app {

/// The round number (1, 2, 2.5 or 5 times a power of ten) next to x > 0: by ratio, not difference.
double nearest_round_number(double x);

/// The smallest round number that is not below x > 0.
double round_number_above(double x);

/// Spacing of isolines over values from 0 to `range`: a round number that gives about 20 of them.
/// 1 where there is no range.
double round_spacing(double range);

/// Marks on a scale.
struct Ticks {
  double step = 0;
  std::vector<double> values;       ///< ascending multiples of the step, 0 itself as plain 0
  std::vector<std::string> labels;  ///< with the same number of decimals; 0 is "0"
};

/// At most `most` (>= 2) ticks in [min, max], min < max, at round numbers; where `spacing` is above
/// 0 they are round multiples of it, if two or more of these fit, so that ticks meet isolines.
Ticks make_ticks(double min, double max, int most, double spacing = 0);

}  // namespace geotherm::app
