// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/path/release.h"

namespace geotherm {

/// Shortens legs that end where they begin, all round; no legs are left of a loop that shrinks to a
/// point. Precondition: release_bends() has nothing left to do. Errors: those of the budget.
Result<void> shorten_loop(const PathSurface& surface, std::vector<Leg>& legs,
                          ShortenBudget& budget);

}  // namespace geotherm
