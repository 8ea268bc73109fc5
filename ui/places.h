// SPDX-License-Identifier: MIT
#pragma once

#include "ui/interface.h"
#include "ui/layout.h"

namespace geotherm::ui {

inline constexpr float kMinCanvas = 200;  ///< pixels at scale 1 that panels leave to the picture
inline constexpr float kMinBar = 240;     ///< width of a side bar, pixels at scale 1
inline constexpr float kMinLog = 70;      ///< height of the log, pixels at scale 1

/// Where panels lie. What is hidden, or has no room, has no width.
struct Places {
  Rect menu, status, left, right, log, canvas;
};

/// Divides a window. `line`: height of menu bar and status bar, pixels. Where room is scarce, side
/// bars and log shrink, then the right one goes, then the left one, the log and the status bar.
/// Nothing overlaps, and nothing is smaller than 0.
Places place_panels(const Layout& layout, float width, float height, float scale, float line);

}  // namespace geotherm::ui
