// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/measure.h"

namespace geotherm::bench {

/// One view of the gargoyle at 1280x720, or the replacement of its distances ("update"). Times are
/// the least of several frames in memory, the views taking turns.
struct RenderRow {
  std::string view;
  Index triangles = 0;
  int samples = 0;
  double frame_ms = kNotMeasured;
  double fill_ms = kNotMeasured;  ///< the same mesh as a bare shaded fill

  double ratio() const { return frame_ms / fill_ms; }
};

struct RenderBench {
  std::string device;  ///< what drew
  double peak_mb = 0;  ///< device memory of the largest mesh at 4 samples, 2^20 bytes
  std::vector<RenderRow> rows;
  std::string failure;  ///< why there are no more rows; empty: all there
};

/// Every view at 69k, 262k and 1.1M triangles, one and four samples a pixel.
RenderBench measure_render(const Say& say);

}  // namespace geotherm::bench
