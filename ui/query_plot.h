// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm::ui {

struct Frame;

/// The last queries as columns, the newest on the right: diffuse, gradient, poisson on each other.
void draw_query_plot(Frame& frame);

}  // namespace geotherm::ui
