// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// What floats over the picture: the hint where there is no model, which of A and B is shown, the
/// picked point, and failures for a while.
void draw_canvas_overlay(Frame& frame);

/// Makes notices of the failures that the log has gained.
void take_notices(Frame& frame);

}  // namespace geotherm::ui
