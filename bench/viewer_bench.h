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

/// What the viewer does while somebody's hand is on the mouse, at 1280x800 in memory and without
/// the panels. Medians, but for the longest frame of three switches.
struct ExploreRow {
  std::string mesh;
  Index faces = 0;
  // A source is dragged: from one picture with new distances to the next, and what it consists of.
  double drag_ms = kNotMeasured;
  double query_ms = kNotMeasured, upload_ms = kNotMeasured, frame_ms = kNotMeasured;
  // t is switched: the longest frame while the worker factors, and that time.
  double switch_ms = kNotMeasured;
  double longest_frame_ms = kNotMeasured, usual_frame_ms = kNotMeasured;

  double drag_ratio() const { return drag_ms / (query_ms + upload_ms + frame_ms); }
  double frame_ratio() const { return longest_frame_ms / usual_frame_ms; }
};

struct ExploreBench {
  std::vector<ExploreRow> rows;
  std::string failure;  ///< why there are no more rows; empty: all there
};

/// The gargoyle at 69k and 200k triangles.
ExploreBench measure_explore(const Say& say);

}  // namespace geotherm::bench
