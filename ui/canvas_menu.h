// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "app/session/explored.h"
#include "ui/key_map.h"

namespace geotherm::ui {

struct Frame;

/// Sends what a click on a point of the surface does. Precondition: a model is shown.
void send_point_command(Frame& frame, MouseAction action, const SurfacePoint& point);

/// The menu of a point, at the pointer; without one it has the entries that need none.
void open_canvas_menu(Frame& frame, const std::optional<SurfacePoint>& point);
void draw_canvas_menu(Frame& frame);

}  // namespace geotherm::ui
