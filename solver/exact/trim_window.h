// SPDX-License-Identifier: MIT
#pragma once

#include "geotherm/types.h"
#include "solver/exact/window.h"

namespace geotherm {

/// Distances closer than this to each other count as equal, relative to themselves: round-off.
inline constexpr double kTie = 1e-13;

/// Places on a side closer than this to each other stand in no order, relative to the side.
inline constexpr double kOrder = 1e-9;

/// Whether the places, unfolded, and the distances of two windows' sources are one but for
/// round-off.
bool have_same_source(const Window& a, const Window& b);

/// Cuts off a window what its side's ends, at these distances, reach sooner along the side (Xin,
/// Wang 2009, theorem 3.2; and in part). False: nothing is left. Ties stay.
bool trim_by_ends(Window& window, double length, double at_origin, double at_length);

/// What Propagation knows of the shortest line yet to the corner opposite to a side.
struct Leader {
  double distance = kUnreached;
  double crossing = 0;  ///< where the line crosses the side
  Window window{};
};

/// On which sides of the corner ahead a window's lines pass.
struct Passage {
  bool left, right;
};

/// Cuts off what crosses a shorter line to the corner at (apex_x, apex_y) (Chen, Han 1990: one
/// angle, one split), and makes a window the leader that has a shorter one. `passage` is where the
/// window goes; both: it has a line to the corner. False: nothing is left.
bool yield_to_leader(Window& window, double length, double apex_x, double apex_y, Leader& leader,
                     Passage& passage);

}  // namespace geotherm
