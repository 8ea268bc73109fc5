// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/path/release.h"

namespace geotherm {

/// Looks for shorter paths on the other sides of the vertices that a path passes: there is a
/// straight path on each side of a vertex whose faces have less than 2 pi, and the one at hand need
/// not be the shorter. Each such vertex is passed on its other side, the bends are released, and
/// what is shorter is kept, until no such change is. Precondition: release_bends() has nothing left
/// to do, and has nothing afterwards. Errors: those of the budget.
Result<void> try_other_sides(const PathSurface& surface, std::vector<Leg>& legs,
                             ShortenBudget& budget);

}  // namespace geotherm
