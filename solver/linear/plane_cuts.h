// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "solver/linear/separator.h"

namespace geotherm {

/// Separators that planes leave: of each direction the plane of least cost (separator_cost()) that
/// keeps a quarter of the vertices on each side at least. `most` directions at most, best first;
/// none where no plane keeps the balance. The directions are the eight, among the axes and the
/// diagonals between two of them, along which the part is longest, without those along which it is
/// thin. The result does not depend on `threads`. Cost: one pass over the edges, one over the
/// vertices for each direction.
std::vector<Separator> plane_cuts(const GraphPart& part, int most, int threads);

}  // namespace geotherm
