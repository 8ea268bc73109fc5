// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/report.h"

namespace geotherm::bench {

/// Set-up, query, batch and memory over the number of faces, one colour for each backend of the
/// heat method and for the baseline, as an SVG picture that needs nothing else; readable on light
/// and dark pages. Lines join the irregular mesh that was measured at most sizes; the others are
/// marks. Figures that are not there leave gaps.
std::string performance_chart(const BenchRun& run);

}  // namespace geotherm::bench
