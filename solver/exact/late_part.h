// SPDX-License-Identifier: MIT
#pragma once

#include "solver/exact/window.h"

namespace geotherm {

/// Cuts off the ends of a window where another window on the same edge is as early. Both stand in
/// one frame of the edge, from any of its faces. False: nothing is left. A later part in the middle
/// stays. (In whole: the trimming of Mitchell, Mount, Papadimitriou 1987.)
bool cut_late_ends(Window& window, const Window& other, double length);

}  // namespace geotherm
