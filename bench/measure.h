// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contender.h"

namespace geotherm::bench {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// What one contender did on one mesh. Times are medians.
struct Figures {
  std::string name;
  double setup_ms = kNotMeasured;
  double query_ms = kNotMeasured;
  double batch_ms_per_source = kNotMeasured;
  double factor_mb = kNotMeasured;
  double peak_mb = kNotMeasured;  ///< of set-up and first query, mesh not counted
  std::string failure;            ///< empty: none
};

/// How long a measurement may take: one contender repeats until it has used `milliseconds` and has
/// `least` results, or has used `most_milliseconds`, whatever comes first.
struct Budget {
  double milliseconds;
  std::size_t least;
  double most_milliseconds;
};

struct Effort {
  Budget setup, query, batch;
};

using Say = std::function<void(std::string_view)>;

/// Measures all contenders on one mesh, taking turns, so that a change of the machine's pace meets
/// them alike. They are left set up.
std::vector<Figures> measure(std::shared_ptr<const TriangleMesh> mesh,
                             std::span<const std::unique_ptr<Contender>> contenders,
                             std::span<const Index> sources, const Effort& effort, const Say& say);

}  // namespace geotherm::bench
