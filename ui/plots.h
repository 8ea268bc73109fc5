// SPDX-License-Identifier: MIT
#pragma once

#include "app/session/check.h"
#include "ui/frame.h"

namespace geotherm::ui {

/// How many vertices have which signed error, with 0 marked; shows a part's figures on hover.
void draw_error_plot(Frame& frame, const ErrorHistogram& histogram);

struct Frame;

/// The last queries as columns, the newest on the right: diffuse, gradient, poisson on each other.
void draw_query_plot(Frame& frame);

}  // namespace geotherm::ui
