// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// Both side bars and the log, with the edges that resize them.
void draw_side_bars(Frame& frame);

}  // namespace geotherm::ui
