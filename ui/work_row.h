// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// What the background works at, with a bar and a button to stop it; or whether what is shown
/// belongs to the settings.
void draw_work_row(Frame& frame);

/// A bar across the row, `share` from 0 to 1, negative: unknown.
void draw_progress(Frame& frame, double share, float height);

}  // namespace geotherm::ui
