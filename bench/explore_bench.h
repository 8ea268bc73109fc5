// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/measure.h"

namespace geotherm::bench {

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
