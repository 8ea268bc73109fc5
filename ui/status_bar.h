// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// What is shown, what goes on, and how fast, along the lower edge.
void draw_status_bar(Frame& frame);

}  // namespace geotherm::ui
